// SPDX-License-Identifier: MIT
// The C ABI of learn.wasm: recordings of friction in, a material file out. Handles are created by
// learn_create and ended by learn_destroy. Errors of a recording are texts, never traps; only a lack of
// memory traps.
#include <cstdint>
#include <string>
#include <vector>

#include "material/learned_material.hpp"
#include "material/material_text.hpp"

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using namespace tribo;

struct Learning {
    std::vector<noise::Recording> recordings;
    std::vector<material::RecordingSource> sources;
    std::string text, warnings;
};

}  // namespace

TRIBO_EXPORT(learn_create) Learning* learn_create() {
    return new Learning;
}
TRIBO_EXPORT(learn_destroy) void learn_destroy(Learning* l) {
    delete l;
}

// Adds a mono recording. The caller must write its samples, full scale 1, to the returned address before any
// other call. Channels and bits (0: not integers) as in its file.
TRIBO_EXPORT(learn_add)
double* learn_add(Learning* l, const char* name, std::uint32_t name_bytes, std::uint32_t samples,
                  double sample_rate_hz, double speed_mm_per_s, double force_n, std::int32_t channels,
                  std::int32_t bits) {
    const std::string file(name, name_bytes);
    l->recordings.push_back({file, speed_mm_per_s, force_n, sample_rate_hz, std::vector<double>(samples)});
    l->sources.push_back(
        {.file = file, .sample_rate_hz = sample_rate_hz, .channels = channels, .bits = bits});
    return l->recordings.back().samples.data();
}

// Returns 1 on success: learn_text() is the material file, still without a picture. Returns 0 on failure:
// learn_text() is the error.
TRIBO_EXPORT(learn_run) std::uint32_t learn_run(Learning* l) {
    const noise::LearningOptions options;
    const Result<noise::Learned> learned = noise::learn(l->recordings, options);
    l->warnings.clear();
    if (!learned) {
        l->text = learned.error().text();
        return 0;
    }
    for (const Warning& w : learned->warnings) l->warnings += w.message() + '\n';
    l->text = material::material_text(material::learned_material({}, *learned, options, l->sources));
    return 1;
}

// UTF-8 with a terminating zero.
TRIBO_EXPORT(learn_text) const char* learn_text(const Learning* l) {
    return l->text.c_str();
}

// One warning per line: UTF-8 with a terminating zero.
TRIBO_EXPORT(learn_warnings) const char* learn_warnings(const Learning* l) {
    return l->warnings.c_str();
}
