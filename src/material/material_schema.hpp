// SPDX-License-Identifier: MIT
// The one description of a material file (docs/material.md): every key with its type, range and default, and
// the rules between keys. `describe` shows the fields of an object to a visitor in the order of the file. The
// visitors read, write or list materials: material_json.cpp, material_text.cpp, voice_numbers.cpp,
// material_fields.cpp. The reader of the page uses the list of fields.
//
// A visitor has
//
//     kReads                               true: the struct is filled from the file
//     schema(text)                         the key `schema`, which holds exactly this text
//     text(key, string)                    at most kLongestText bytes; absent: ""
//     number(key, value, range, absent)    double or int; without `absent` it must be there
//     numbers(key, list, range, most)      must be there; a std::optional list need not
//     tables(key, lists, range, most)      must be there; kLongestTable numbers each
//     object(key, value, present)          may be absent; a writer writes it where `present`
//     object(key, optional)                the same
//     objects(key, most, count, item)      may be absent; calls item(visitor, n) for each
//     unheard(part)                        part(visitor): fields that a finger's sound does without
//     expect(holds, key, cause, remedy)    a rule between fields; readers refuse where it is broken
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/limits.hpp"
#include "material/material.hpp"
#include "noise/model/voice_map.hpp"

namespace tribo::material {

inline constexpr const char* kMaterialSchema = "tribo.material/1";
inline constexpr std::size_t kLongestText = 10'000, kLongestTable = 256;
inline constexpr std::size_t kMostVoices = 64, kMostRecordings = 256;

// Value of an absent number.
struct Absent {
    double value = 0;
    bool left_out = false;  // a writer omits the number if it has this value
};

// Copies of the table's ranges: a module that reads no text then holds none of the table's texts.
inline constexpr Range kStiffness = kLimits.sheet_stiffness.range;
inline constexpr Range kViscosity = kLimits.sheet_viscosity.range;
inline constexpr Range kWidth = kLimits.material_width.range, kHighpass = kLimits.noted_highpass.range;
inline constexpr Range kOptical = kLimits.optical_share.range, kRoughness = kLimits.roughness.range;
inline constexpr Range kSpeed = kLimits.finger_speed.range, kForce = kLimits.finger_force.range;
inline constexpr Range kLevel = kLimits.voice_level.range, kModelRate = kLimits.model_rate.range;
// Of what learning measures.
inline constexpr Range kShare{0, 1};
inline constexpr Range kBand{0, 0.5 * kModelRate.max, true};  // also below half the rate of the model
inline constexpr Range kReflection{-noise::kLargestReflection, noise::kLargestReflection};

template <class Visitor>
void describe(Visitor& f, RecordingSource& s) {
    f.text("file", s.file);
    f.number("seconds", s.seconds, {0, 1e6}, Absent{0});
    f.number("sample_rate_hz", s.sample_rate_hz, {1, 1e7});
    f.number("channels", s.channels, {1, 1024}, Absent{1});
    f.number("bits", s.bits, {0, 64}, Absent{0, true});
    f.number("peak_db", s.peak_db, {-400, 100}, Absent{0});
    f.number("silent_share", s.silent_share, kShare, Absent{0});
    f.number("clipped_share", s.clipped_share, kShare, Absent{0});
}

template <class Visitor>
void describe(Visitor& f, noise::BassModel& bass) {
    f.number("share", bass.share, kShare);
    f.number("sample_rate_hz", bass.spectrum.sample_rate_hz, {2 * noise::kBassHz, 2 * noise::kBassRateHz});
    f.numbers("reflection", bass.spectrum.reflection, kReflection, noise::kLargestOrder);
}

template <class Visitor>
void describe(Visitor& f, noise::GrainModel& g) {
    f.number("per_mm", g.per_mm, {0, 1e4});
    f.number("share", g.share, kShare);
    f.number("scatter", g.scatter, kShare, Absent{1});
    f.numbers("sizes", g.sizes, {-1e4, 1e4}, noise::kMostGrainSizes);
    f.numbers("shape", g.shape, {-1, 1}, noise::kLongestGrain);
    f.expect(std::ranges::is_sorted(g.sizes), "sizes", "does not rise", "sort it");
}

template <class Visitor>
void describe(Visitor& f, noise::TextureModel& t) {
    f.numbers("crossovers_hz", t.crossovers_hz, kBand, noise::kMostBands - 1);
    f.tables("levels_db", t.levels_db, {-300, 100}, noise::kMostBands);
    const auto whole = [](const std::vector<double>& table) { return table.size() == noise::kLevelSteps; };
    f.expect(t.levels_db.size() == t.crossovers_hz.size() + 1 && std::ranges::all_of(t.levels_db, whole) &&
                 std::ranges::is_sorted(t.crossovers_hz),
             "levels_db", "does not fit crossovers_hz",
             "give 17 levels for each band, one band more than rising crossovers");
    f.number("coherence", t.coherence, kShare);
    f.numbers("lengths_mm", t.lengths_mm, {0, 1e6, true}, noise::kMostLengths);
    f.numbers("weights", t.weights, kShare, noise::kMostLengths);
    double sum = 0;
    for (const double weight : t.weights) sum += weight;
    f.expect(t.weights.size() == t.lengths_mm.size() && (t.weights.empty() || std::abs(sum - 1) <= 1e-3),
             "weights", "is not one share for each length, sum 1", "let them add up to 1");
    f.object("grains", t.grains, t.grains.per_mm > 0);
}

// Line spectral frequencies of a model, rounded to a hundredth of a hertz.
std::vector<double> line_spectrum_hz(const noise::ArModel& model);

template <class Visitor>
void describe(Visitor& f, noise::VoiceModel& v, std::vector<RecordingSource>* sources) {
    f.number("speed_mm_per_s", v.speed_mm_per_s, kSpeed);
    f.number("force_n", v.force_n, kForce, Absent{1});
    f.number("level_db", v.level_db, kLevel);
    f.number("sample_rate_hz", v.spectrum.sample_rate_hz, kModelRate);
    f.numbers("reflection", v.spectrum.reflection, kReflection, noise::kLargestOrder);
    const double highest_hz = 0.5 * v.spectrum.sample_rate_hz;
    f.unheard([&](auto& whole) {
        // For readers that prefer them; the reflection coefficients are decisive.
        std::optional<std::vector<double>> lines;
        if constexpr (!Visitor::kReads) lines = line_spectrum_hz(v.spectrum);
        whole.numbers("line_spectrum_hz", lines, {0, 0.5 * kModelRate.max}, noise::kLargestOrder);
        whole.expect(
            !lines || (lines->size() == v.spectrum.reflection.size() && std::ranges::is_sorted(*lines) &&
                       (lines->empty() || lines->back() <= highest_hz)),
            "line_spectrum_hz",
            "is not one rising frequency for each reflection coefficient, up to half the sample rate",
            "leave it out");
        whole.object("bass", v.bass);
    });
    f.object("texture", v.texture);
    f.expect(!v.texture || v.texture->crossovers_hz.empty() || v.texture->crossovers_hz.back() <= highest_hz,
             "texture.crossovers_hz", "goes beyond half the sample rate", "give crossovers below it");
    f.unheard([&](auto& whole) {
        whole.objects("recordings", kMostRecordings, sources->size(), [&](auto& item, std::size_t n) {
            if constexpr (Visitor::kReads) sources->emplace_back();
            describe(item, (*sources)[n]);
        });
    });
}

template <class Visitor>
void describe(Visitor& f, noise::LevelLaw& law) {
    constexpr Range kSlope{-noise::kSteepestLawDb, noise::kSteepestLawDb};
    f.number("level_db", law.level_db, kLevel);
    f.number("db_per_decade_speed", law.db_per_decade_speed, kSlope);
    f.number("db_per_decade_force", law.db_per_decade_force, kSlope);
}

// `sources`: of each model; null for a visitor without unheard parts.
template <class Visitor>
void describe(Visitor& f, noise::MaterialVoices& voices, std::vector<std::vector<RecordingSource>>* sources) {
    const bool has_law = f.object("level_law", voices.law, !voices.models.empty());
    f.objects("voices", kMostVoices, voices.models.size(), [&](auto& voice, std::size_t n) {
        if constexpr (Visitor::kReads) {
            voices.models.emplace_back();
            if (sources) sources->emplace_back();
        }
        noise::VoiceModel& v = voices.models[n];
        describe(voice, v, sources ? &(*sources)[n] : nullptr);
        const noise::VoiceModel* before = n > 0 ? &voices.models[n - 1] : nullptr;
        voice.expect(!before || v.force_n > before->force_n ||
                         (v.force_n == before->force_n && v.speed_mm_per_s > before->speed_mm_per_s),
                     "speed_mm_per_s", "does not rise",
                     "sort the voices by force, then speed, each pair once");
    });
    if (Visitor::kReads && !has_law) voices.law = noise::fit_level_law(voices.models);
}

template <class Visitor>
void describe(Visitor& f, Material& m) {
    const Material usual;
    f.schema(kMaterialSchema);
    f.text("name", m.name);
    f.text("note", m.note);
    f.number("stiffness_n_per_mm", m.stiffness_n_per_mm, kStiffness);
    f.number("viscosity_n_s_per_mm", m.viscosity_n_s_per_mm, kViscosity);
    f.number("width_mm", m.width_mm, kWidth, Absent{usual.width_mm, true});
    f.text("image", m.image);
    f.text("height_map", m.height_map);
    f.expect(m.height_map.empty() || !m.image.empty(), "height_map", "is given without an image",
             "name the image that it belongs to as well");
    f.number("relief_slope", m.relief_slope, kOptical, Absent{usual.relief_slope, true});
    f.number("gloss", m.gloss, kOptical, Absent{usual.gloss, true});
    f.number("roughness", m.roughness, kRoughness, Absent{usual.roughness, true});
    f.number("pile", m.pile, kOptical, Absent{usual.pile, true});
    f.text("method", m.method);
    f.number("highpass_hz", m.highpass_hz, kHighpass, Absent{usual.highpass_hz, true});
    describe(f, m.voices, &m.sources);
}

}  // namespace tribo::material
