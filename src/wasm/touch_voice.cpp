// SPDX-License-Identifier: MIT
// The C ABI of touch.wasm for the AudioWorklet: a friction voice. Handles are created by voice_create and
// ended by voice_destroy.
#include <cstdint>

#include "material/voice_numbers.hpp"
#include "noise/play/friction_voice.hpp"

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using namespace tribo;
using noise::FrictionVoice;

// The reason of a failed voice_create. The longest text: line_spectrum_hz, and a cause of three times its
// length.
char refusal_text[128];

void keep(const material::Refusal& refusal) {
    char* to = refusal_text;
    for (const char* part : {refusal.key, " ", refusal.cause}) {
        for (; *part != '\0' && to < refusal_text + sizeof refusal_text - 1; ++part) *to++ = *part;
    }
    *to = '\0';
}

}  // namespace

// Makes a voice from the numbers of material/voice_numbers.hpp. Returns null if they are not valid voices or
// the rate is not within 1000 to 192000 Hz; voice_refusal() then gives the reason.
TRIBO_EXPORT(voice_create)
FrictionVoice* voice_create(const double* numbers, std::uint32_t length, double sample_rate_hz,
                            std::uint32_t seed, std::uint32_t as_published) {
    material::Refusal refusal{"sample rate", "is not from 1000 to 192000 Hz"};
    const auto voices = sample_rate_hz >= 1000 && sample_rate_hz <= 192000
                            ? material::voices_of({numbers, length}, refusal)
                            : std::nullopt;
    if (!voices) {
        keep(refusal);
        return nullptr;
    }
    noise::FrictionOptions options;
    options.sample_rate_hz = sample_rate_hz;
    options.seed = seed;
    options.as_published = as_published != 0;
    return new FrictionVoice(*voices, options);
}
// ASCII text with a terminating zero: the key and its error.
TRIBO_EXPORT(voice_refusal) const char* voice_refusal() {
    return refusal_text;
}

TRIBO_EXPORT(voice_destroy) void voice_destroy(FrictionVoice* voice) {
    delete voice;
}
TRIBO_EXPORT(voice_set_target)
void voice_set_target(FrictionVoice* voice, double speed_mm_per_s, double force_n) {
    voice->set_target(speed_mm_per_s, force_n);
}
TRIBO_EXPORT(voice_render) void voice_render(FrictionVoice* voice, float* out, std::uint32_t frames) {
    voice->render({out, frames});
}
// RMS level of the current speed and force, full scale 1.
TRIBO_EXPORT(voice_gain) double voice_gain(const FrictionVoice* voice) {
    return voice->target_gain();
}
