// SPDX-License-Identifier: MIT
// Any bytes give finite samples, or an error with a remedy; what is sound can be tried to learn from.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "files/sound/sound_file.hpp"
#include "noise/learn/learning.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 17;
    if (size > largest) return 0;
    const auto sound = files::parse_sound({reinterpret_cast<const char*>(data), size}, "fuzz.wav");
    if (!sound) {
        if (sound.error().cause.empty() || sound.error().remedy.empty()) std::abort();
        return 0;
    }
    if (sound->samples.empty() || !(sound->sample_rate_hz > 0)) std::abort();
    for (const double v : sound->samples) {
        if (!std::isfinite(v)) std::abort();
    }
    constexpr std::size_t few = 30'000;
    noise::Recording recording{"fuzz.wav", 100, 1, sound->sample_rate_hz, sound->samples};
    if (recording.samples.size() > few) recording.samples.resize(few);
    noise::LearningOptions options;
    options.order = 8;
    options.textures = false;
    const auto learned = noise::learn({&recording, 1}, options);
    if (!learned) return 0;
    for (const double k : learned->voices.models.at(0).spectrum.reflection) {
        if (!(std::abs(k) < 1)) std::abort();
    }
    return 0;
}
