// SPDX-License-Identifier: MIT
#include <array>

#include "base/hash.hpp"
#include "base/math.hpp"
#include "base/noise_hash.hpp"
#include "golden/golden.hpp"
#include "noise/learn/learning.hpp"
#include "noise/play/friction_voice.hpp"

namespace tribo::golden {
namespace {

// Noise through a resonance, louder and softer three times a second, with a click every 37 ms.
noise::Recording rubbed(double speed, double rate_hz, double seconds, std::uint64_t seed) {
    noise::Recording r{"rub", speed, 1, rate_hz, {}};
    const CounterNoise noise(seed);
    const double turn = math::kTwoPi * 900 / rate_hz;
    const auto every = static_cast<std::size_t>(0.037 * rate_hz);
    double one = 0, two = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(seconds * rate_hz); ++n) {
        const double t = static_cast<double>(n) / rate_hz;
        const double louder = 1 + 0.6 * math::sin(math::kTwoPi * 3 * t);
        const double drive =
            louder * noise.gaussian(n) + (n % every == 0 ? 40 * noise.uniform(n + (1ULL << 40)) : 0);
        const double x = drive + 2 * 0.95 * math::cos(turn) * one - 0.95 * 0.95 * two;
        two = one;
        one = x;
        r.samples.push_back(2e-5 * speed * x);
    }
    return r;
}

}  // namespace

// Recordings to the voices of a material, by both methods and with textures by one of them; those voices
// played.
std::uint64_t learning() {
    const std::array recordings{rubbed(40, 44100, 0.5, 1), rubbed(400, 60000, 0.4, 2)};
    Hash hash;
    for (const noise::Method method : {noise::Method::yule_walker, noise::Method::burg}) {
        noise::LearningOptions options;
        options.method = method;
        if (method == noise::Method::burg) {
            options.order = 24;
            options.textures = false;
        }
        const auto learned = noise::learn(recordings, options);
        if (!learned || learned->voices.models.size() != recordings.size()) return 0;
        hash.add(learned->order);
        hash.add(learned->held_out_db);
        for (const noise::VoiceModel& m : learned->voices.models) {
            hash.add(m.level_db);
            hash.add(m.spectrum.sample_rate_hz);
            hash.add(m.spectrum.reflection);
            if (m.bass) hash.add(m.bass->spectrum.reflection);
            if (!m.texture) continue;
            hash.add(m.texture->crossovers_hz);
            for (const auto& table : m.texture->levels_db) hash.add(table);
            hash.add(m.texture->lengths_mm);
            hash.add(m.texture->weights);
            hash.add(m.texture->coherence);
            hash.add(m.texture->grains.per_mm);
            hash.add(m.texture->grains.sizes);
            hash.add(m.texture->grains.shape);
        }
        hash.add(learned->voices.law.level_db);
        hash.add(learned->voices.law.db_per_decade_speed);
        noise::FrictionVoice voice(learned->voices, {.sample_rate_hz = 48000, .seed = 7});
        std::array<float, 480> block;
        for (int n = 0; n < 50; ++n) {
            voice.set_target(10.0 * n, 0.5 + 0.01 * n);
            voice.render(block);
            hash.add(block);
        }
    }
    return hash.value();
}

}  // namespace tribo::golden
