// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <random>

#include "noise/learn/learning.hpp"
#include "noise/learn/sound_statistics.hpp"
#include "noise/play/model_noise.hpp"
#include "noise/play/texture_excitation.hpp"

namespace tribo::noise {
namespace {

// Impulses at random places through a resonance, on a quiet floor: grain whose rate and sizes are known.
struct Grain {
    double per_mm = 0.5, speed = 100, rate_hz = 44100, seconds = 10;
    double scatter = 1;   // 1: at random, 0: evenly spaced
    double floor = 0.02;  // of the floor, where grains are about 1
    unsigned seed = 1;
    std::size_t count = 0;  // of grains drawn

    std::vector<double> samples() {
        std::mt19937_64 random(seed);
        std::normal_distribution<double> gauss;
        std::uniform_real_distribution<double> share;
        std::vector<double> drive(static_cast<std::size_t>(seconds * rate_hz));
        for (double& v : drive) v = floor * gauss(random);
        const double mean_gap = rate_hz / (per_mm * speed);
        for (double at = mean_gap * share(random); at < static_cast<double>(drive.size()); ++count) {
            drive[static_cast<std::size_t>(at)] +=
                (0.6 + 0.8 * share(random)) * (share(random) < 0.5 ? -1 : 1);
            at += mean_gap * ((1 - scatter) - scatter * std::log(1 - share(random)));
        }
        // 1 / (1 - 2 r cos(w) z^-1 + r^2 z^-2), 2.5 kHz, ringing for a millisecond.
        const double r = 0.978, b = 2 * r * std::cos(2 * std::numbers::pi * 2500 / rate_hz);
        double y1 = 0, y2 = 0;
        for (double& v : drive) {
            const double y = v + b * y1 - r * r * y2;
            y2 = y1;
            y1 = y;
            v = 0.02 * y;
        }
        return drive;
    }
};

VoiceModel learned(const std::vector<double>& samples, double rate_hz, double speed) {
    const Recording r{"grain.wav", speed, 1, rate_hz, samples};
    auto result = learn({&r, 1});
    EXPECT_TRUE(result) << result.error().text();
    return result->voices.models.at(0);
}

std::vector<double> played(const VoiceModel& m, double seconds, double speed, std::uint64_t seed,
                           bool gaussian = false) {
    ModelNoise noise(m.spectrum, gaussian || !m.texture ? nullptr : &*m.texture, seed);
    const double rate = m.spectrum.sample_rate_hz;
    std::vector<double> x;
    for (std::uint64_t n = 0; static_cast<double>(x.size()) < seconds * rate; ++n)
        for (const float v : noise.block(n, speed * 64 / rate)) x.push_back(v);
    return x;
}

// Grains heard: places where the short-time envelope rises through a third of its largest values (grains of
// the recordings below are between 0.4 and 1 of the largest, their floor below 0.25).
double grains_per_s(const std::vector<double>& x, double rate_hz) {
    std::vector<double> sorted(x.size());
    std::ranges::transform(x, sorted.begin(), [](double v) { return std::abs(v); });
    std::ranges::nth_element(sorted, sorted.end() - static_cast<std::ptrdiff_t>(x.size() / 2000));
    const double high = sorted[sorted.size() - x.size() / 2000] / 3;
    double envelope = 0, count = 0;
    bool inside = false;
    const double fall = std::exp(-1 / (0.0015 * rate_hz));
    for (const double v : x) {
        envelope = std::max(std::abs(v), envelope * fall);
        if (!inside && envelope > high) ++count;
        inside = inside ? envelope > 0.5 * high : envelope > high;
    }
    return count * rate_hz / static_cast<double>(x.size());
}

TEST(Texture, grain_of_known_rate_is_learned_and_played_within_15_per_cent) {
    for (const double per_mm : {0.25, 0.6, 1.5}) {
        {
            const double scatter = per_mm < 1 ? 1 : 0.3;
            Grain grain;
            grain.per_mm = per_mm;
            grain.scatter = scatter;
            const std::vector<double> x = grain.samples();
            const VoiceModel m = learned(x, grain.rate_hz, grain.speed);
            ASSERT_TRUE(m.texture);
            const double true_rate = static_cast<double>(grain.count) / (grain.seconds * grain.speed);
            EXPECT_NEAR(m.texture->grains.per_mm / true_rate, 1, 0.15) << per_mm;
            EXPECT_NEAR(m.texture->grains.scatter, scatter, 0.15) << per_mm;
            std::vector<double> kurtoses, rates;
            for (std::uint64_t seed = 1; seed <= 9; ++seed) {
                const std::vector<double> y = played(m, grain.seconds, grain.speed, seed);
                kurtoses.push_back(kurtosis(y));
                rates.push_back(grains_per_s(y, grain.rate_hz));
            }
            std::ranges::sort(kurtoses);
            std::ranges::sort(rates);
            EXPECT_NEAR(kurtoses[4] / kurtosis(x), 1, 0.15) << per_mm << " " << scatter;
            // Grains that overlap are counted as one, in the recording as in the imitation.
            const double recorded = grains_per_s(x, grain.rate_hz);
            EXPECT_NEAR(recorded / (true_rate * grain.speed), 1, 0.15) << per_mm << " " << scatter;
            EXPECT_NEAR(rates[4] / recorded, 1, 0.1) << per_mm << " " << scatter;
            EXPECT_NEAR(rates[4] / (true_rate * grain.speed), 1, 0.15) << per_mm << " " << scatter;
        }
    }
}

TEST(Texture, grains_come_faster_as_the_finger_moves_faster) {
    Grain grain;
    const VoiceModel m = learned(grain.samples(), grain.rate_hz, grain.speed);
    // The same surface, rubbed at another speed: what is to be heard there.
    for (const double speed : {50.0, 200.0}) {
        Grain there = grain;
        there.speed = speed;
        there.seconds = 40;
        there.seed = 2;
        there.count = 0;
        const double expected = grains_per_s(there.samples(), grain.rate_hz);
        EXPECT_NEAR(static_cast<double>(there.count) / there.seconds, 0.5 * speed, 0.1 * 0.5 * speed);
        EXPECT_NEAR(grains_per_s(played(m, 40, speed, 1), grain.rate_hz) / expected, 1, 0.15) << speed;
    }
}

// A surface with what is asked for: clicks at random places, a level that wanders like a Markov process, and
// the hand that rubs it.
struct Surface {
    double clicks_per_s, click;         // over a floor of 1, 0.5 to 1.5 times
    double level_db, memory_s;          // deviation of the level, and how long it lasts
    double hand_db, hand_hz;            // the hand's level swings by +-hand_db
    double pole_hz = 2500, pole = 0.8;  // of a resonance

    static constexpr double kRate = 44100;

    std::vector<double> rubbed(double seconds, unsigned seed, bool by_hand) const {
        std::mt19937_64 random(seed);
        std::normal_distribution<double> gauss;
        std::uniform_real_distribution<double> share;
        const double none = 1e300, keep = std::exp(-1 / (memory_s * kRate)),
                     renew = std::sqrt(1 - keep * keep);
        const double b = 2 * pole * std::cos(2 * std::numbers::pi * pole_hz / kRate);
        double level = gauss(random), y1 = 0, y2 = 0;
        const auto gap = [&] {
            return clicks_per_s > 0 ? -std::log(1 - share(random)) * kRate / clicks_per_s : none;
        };
        double next = gap();
        std::vector<double> x(static_cast<std::size_t>(seconds * kRate));
        for (std::size_t n = 0; n < x.size(); ++n) {
            level = keep * level + renew * gauss(random);
            double drive = gauss(random) * std::pow(10, 0.05 * level_db * level);
            for (; static_cast<double>(n) >= next; next += gap()) {
                drive += click * (0.5 + share(random)) * (share(random) < 0.5 ? -1 : 1);
            }
            const double y = drive + b * y1 - pole * pole * y2;
            y2 = y1;
            y1 = y;
            const double phase = 2 * std::numbers::pi * hand_hz * static_cast<double>(n) / kRate;
            x[n] = 0.003 * y * (by_hand ? std::pow(10, 0.05 * hand_db * std::sin(phase)) : 1);
        }
        return x;
    }
};

// Power of the envelope's fluctuation from 4 to 32 Hz, dB.
double modulation_db(const std::vector<double>& x, double rate_hz) {
    const std::vector<double> hz{4.76, 6.73, 9.51, 13.5, 19.0, 26.9};
    const std::vector<double> density = modulation_density(x, rate_hz, hz);
    double sum = 0;
    for (std::size_t n = 0; n < hz.size(); ++n) sum += hz[n] * density[n];
    return 10 * std::log10(sum);
}

TEST(Texture, is_the_surfaces_and_not_the_hands) {
    const std::vector<Surface> surfaces{
        {100, 25, 0, 0.01, 0, 1},  {40, 20, 0, 0.01, 4, 2.8}, {200, 30, 0, 0.01, 6, 1.5, 5000, 0.65},
        {0, 0, 4, 0.01, 0, 1},     {0, 0, 6, 0.004, 5, 2},    {0, 0, 3, 0.02, 6, 1.2, 1200, 0.9},
        {40, 20, 2.5, 0.03, 0, 1}, {300, 12, 3, 0.008, 6, 1}, {60, 15, 4.5, 0.004, 5, 2.2, 3500, 0.9},
    };
    for (std::size_t n = 0; n < surfaces.size(); ++n) {
        const Surface& s = surfaces[n];
        const auto seed = static_cast<unsigned>(70 + n);
        const Recording r{"rubbed.wav", 100, 1, s.kRate, s.rubbed(5, seed, true)};
        auto learned = learn({&r, 1}, {.order = 16});
        ASSERT_TRUE(learned);
        const VoiceModel& m = learned->voices.models.at(0);
        // The same surface under a machine that rubs it evenly.
        const std::vector<double> even = s.rubbed(20, seed + 100, false);
        std::vector<double> kurtoses, modulations;
        for (std::uint64_t k = 1; k <= 3; ++k) {
            const std::vector<double> y = played(m, 8, 100, k);
            kurtoses.push_back(kurtosis(y));
            modulations.push_back(modulation_db(y, s.kRate));
        }
        std::ranges::sort(kurtoses);
        std::ranges::sort(modulations);
        EXPECT_LT(std::abs(std::log(kurtoses[1] / kurtosis(even))), std::log(1.5))
            << n << ": " << kurtoses[1] << ", " << kurtosis(even);
        EXPECT_NEAR(modulations[1], modulation_db(even, s.kRate), 2) << n;
    }
}

TEST(Texture, of_gaussian_noise_under_an_unsteady_hand_is_none) {
    for (const double hand_hz : {1.0, 1.7, 2.6}) {
        const Surface s{0, 0, 0, 0.01, 6, hand_hz};
        const std::vector<double> x = s.rubbed(5, 90, true);
        EXPECT_GT(kurtosis(x), 4.5);
        EXPECT_FALSE(learned(x, s.kRate, 100).texture) << hand_hz;
    }
}

TEST(Texture, plays_every_size_of_grain_as_often) {
    TextureModel t;
    t.levels_db.assign(1, std::vector<double>(kLevelSteps, 0.0));
    // Evenly spaced grains and nothing else; one a block of 64 samples.
    t.grains = {1, 1, 0, {-5, -3, 1, 2, 4, 9, 11}, {1}};
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        TextureExcitation excitation(t, 48000, seed);
        std::array<float, 64> block;
        std::map<int, int> count;
        double scale = 0;
        for (const double v : t.grains.sizes) scale += v * v / 7;
        for (std::uint64_t n = 0; n < 70; ++n) {
            excitation.block(n * 64, 1, block);
            for (const float v : block) {
                if (v != 0) ++count[static_cast<int>(std::lround(v * std::sqrt(scale / 64)))];
            }
        }
        ASSERT_EQ(count.size(), t.grains.sizes.size());
        for (const double v : t.grains.sizes) EXPECT_NEAR(count[static_cast<int>(v)], 10, 1) << v;
    }
}

TEST(Texture, driving_noise_is_white_with_a_mean_square_of_1) {
    TextureModel t;
    t.crossovers_hz = {400, 1500, 5000, 12000};
    for (int b = 0; b < 5; ++b) {
        std::vector<double> table;
        for (int n = 0; n < kLevelSteps; ++n) table.push_back(0.8 * (b + 1) * (n - 8));
        t.levels_db.push_back(table);
    }
    t.coherence = 0.5;
    t.lengths_mm = {0.2, 1};
    t.weights = {0.5, 0.5};
    t.grains = {2, 0.3, 1, {-1, -0.5, 0.5, 1}, {1}};
    normalize(t);
    TextureExcitation excitation(t, 48000, 3);
    std::vector<double> x;
    std::array<float, 64> block;
    for (std::uint64_t n = 0; n < 120000; ++n) {
        excitation.block(n * 64, 100.0 * 64 / 48000, block);
        x.insert(x.end(), block.begin(), block.end());
    }
    const std::vector<double> power = power_spectrum(x, 256);
    double mean = 0;
    for (const double p : power) mean += p / static_cast<double>(power.size());
    EXPECT_NEAR(10 * std::log10(mean), 0, 0.3);
    for (std::size_t k = 1; k < power.size(); ++k) EXPECT_NEAR(10 * std::log10(power[k] / mean), 0, 0.7) << k;
}

}  // namespace
}  // namespace tribo::noise
