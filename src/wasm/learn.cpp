// SPDX-License-Identifier: MIT
// The C ABI of learn.wasm: recordings of friction in, the voices of a material out. Handles come from
// learn_create and end with learn_destroy. What is wrong with a recording is said in words, never by a trap;
// memory that runs out is one.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "material/material.hpp"
#include "noise/learn/learning.hpp"

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using namespace tribo;

struct Learning {
    std::vector<noise::Recording> recordings;
    std::string text;
    std::vector<double> numbers, found;
};

void append(std::vector<double>& to, const std::vector<double>& values) {
    to.insert(to.end(), values.begin(), values.end());
}

void append_texture(std::vector<double>& to, const noise::TextureModel& t) {
    append(to, t.crossovers_hz);
    for (const std::vector<double>& table : t.levels_db) append(to, table);
    to.push_back(t.coherence);
    to.push_back(static_cast<double>(t.lengths_mm.size()));
    append(to, t.lengths_mm);
    append(to, t.weights);
    to.insert(to.end(), {t.grains.per_mm, t.grains.share, t.grains.scatter});
    to.push_back(static_cast<double>(t.grains.sizes.size()));
    append(to, t.grains.sizes);
    to.push_back(static_cast<double>(t.grains.shape.size()));
    append(to, t.grains.shape);
}

std::vector<double> numbers_of(const noise::MaterialVoices& voices) {
    std::vector<double> to{static_cast<double>(voices.models.size()), voices.law.level_db,
                           voices.law.db_per_decade_speed, voices.law.db_per_decade_force};
    for (const noise::VoiceModel& m : voices.models) {
        to.insert(to.end(), {m.speed_mm_per_s, m.force_n, m.level_db, m.spectrum.sample_rate_hz});
        to.push_back(static_cast<double>(m.spectrum.reflection.size()));
        append(to, m.spectrum.reflection);
        to.push_back(m.texture ? static_cast<double>(m.texture->levels_db.size()) : 0);
        if (m.texture) append_texture(to, *m.texture);
    }
    // What voice_create does not play: the bass of each voice, its order first.
    for (const noise::VoiceModel& m : voices.models) {
        to.push_back(m.bass ? static_cast<double>(m.bass->spectrum.reflection.size()) : 0);
        if (!m.bass) continue;
        to.insert(to.end(), {m.bass->share, m.bass->spectrum.sample_rate_hz});
        append(to, m.bass->spectrum.reflection);
    }
    return to;
}

}  // namespace

TRIBO_EXPORT(learn_create) Learning* learn_create() {
    return new Learning;
}
TRIBO_EXPORT(learn_destroy) void learn_destroy(Learning* l) {
    delete l;
}

// One more recording, mono; its samples, full scale 1, are to be written where this says, before any other
// call.
TRIBO_EXPORT(learn_add)
double* learn_add(Learning* l, const char* name, std::uint32_t name_bytes, std::uint32_t samples,
                  double sample_rate_hz, double speed_mm_per_s, double force_n) {
    l->recordings.push_back({std::string(name, name_bytes), speed_mm_per_s, force_n, sample_rate_hz,
                             std::vector<double>(samples)});
    return l->recordings.back().samples.data();
}

// 1: learned; 0: something is wrong with a recording.
TRIBO_EXPORT(learn_run) std::uint32_t learn_run(Learning* l, double highpass_hz) {
    l->text.clear();
    noise::LearningOptions options;
    options.highpass_hz = highpass_hz;
    Result<noise::Learned> learned = noise::learn(l->recordings, options);
    if (!learned) {
        l->text = learned.error().text();
        return 0;
    }
    for (const Warning& w : learned->warnings) l->text += w.message() + '\n';
    material::round_digits(learned->voices);
    l->numbers = numbers_of(learned->voices);
    l->found.clear();
    for (const noise::LearnedRecording& r : learned->recordings) {
        l->found.insert(l->found.end(), {static_cast<double>(r.model), r.seconds, r.peak_db, r.silent_share,
                                         r.clipped_share});
    }
    return 1;
}

// What was wrong, or the warnings, one a line: UTF-8 that ends with a zero.
TRIBO_EXPORT(learn_text) const char* learn_text(const Learning* l) {
    return l->text.c_str();
}

// The voices as voice_create of touch.wasm takes them, rounded as in a material file.
TRIBO_EXPORT(learn_numbers) const double* learn_numbers(const Learning* l) {
    return l->numbers.data();
}
TRIBO_EXPORT(learn_number_count) std::uint32_t learn_number_count(const Learning* l) {
    return static_cast<std::uint32_t>(l->numbers.size());
}

// Of each recording as they came: its model, seconds of sound, peak in dB, silent and clipped shares.
TRIBO_EXPORT(learn_found) const double* learn_found(const Learning* l) {
    return l->found.data();
}
