// SPDX-License-Identifier: MIT
// The C ABI of touch.wasm, the AudioWorklet's side: a friction voice. Handles come from voice_create and end
// with voice_destroy.
#include <cstdint>

#include "material/voice_numbers.hpp"
#include "noise/play/friction_voice.hpp"

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using namespace tribo;
using noise::FrictionVoice;

// Why voice_create gave none. The longest: line_spectrum_hz and a cause of three times its length.
char refusal_text[128];

void keep(const material::Refusal& refusal) {
    char* to = refusal_text;
    for (const char* part : {refusal.key, " ", refusal.cause}) {
        for (; *part != '\0' && to < refusal_text + sizeof refusal_text - 1; ++part) *to++ = *part;
    }
    *to = '\0';
}

}  // namespace

// A voice from the numbers of material/voice_numbers.hpp. Null where they are no voices, or the rate is not
// from 1000 to 192000 Hz; voice_refusal() then says why.
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
// Text that ends with a zero, ASCII: the key and what is wrong with it.
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
// RMS, full scale 1, that the present speed and force lead to.
TRIBO_EXPORT(voice_gain) double voice_gain(const FrictionVoice* voice) {
    return voice->target_gain();
}
