// SPDX-License-Identifier: MIT
#include "noise/play/slow_level.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "noise/learn/sound_statistics.hpp"

namespace tribo::noise {
namespace {

constexpr double kRate = 44100, kSeconds = 6;

std::vector<double> gaussian(unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> gauss;
    std::vector<double> x(static_cast<std::size_t>(kSeconds * kRate));
    for (double& v : x) v = 0.05 * gauss(random);
    return x;
}

// A level that swings by +-6 dB.
std::vector<double> swung(std::vector<double> x, double hz) {
    for (std::size_t n = 0; n < x.size(); ++n) {
        const double phase = 2 * std::numbers::pi * hz * static_cast<double>(n) / kRate;
        x[n] *= std::pow(10, 0.3 * std::sin(phase));
    }
    return x;
}

std::vector<double> levelled(const std::vector<double>& x) {
    const std::span<const double> one[] = {x};
    return without_slow_level(one, kRate).at(0);
}

// Greatest gain over least gain of the middle four seconds, dB.
double gain_range_db(const std::vector<double>& before, const std::vector<double>& after) {
    double least = 1e300, most = 0;
    for (auto n = static_cast<std::size_t>(kRate); n < static_cast<std::size_t>((kSeconds - 1) * kRate);
         ++n) {
        if (std::abs(before[n]) < 1e-6) continue;
        least = std::min(least, after[n] / before[n]);
        most = std::max(most, after[n] / before[n]);
    }
    return 20 * std::log10(most / least);
}

TEST(SlowLevel, of_a_hand_is_divided_out) {
    for (const double hz : {0.5, 1.0, 2.0, 2.5}) {
        const std::vector<double> plain = gaussian(1), x = swung(plain, hz), y = levelled(x);
        EXPECT_GT(level_deviation_db(x, kRate, 0.05), 4) << hz;
        // Gaussian noise by itself: 0.13 dB at frames of 50 ms, the hand 4.2 dB.
        EXPECT_LT(level_deviation_db(y, kRate, 0.05), 0.6) << hz;
        EXPECT_NEAR(kurtosis(y), 3, 0.15) << hz;
        EXPECT_LT(gain_range_db(plain, y), 3) << hz;
    }
}

TEST(SlowLevel, leaves_faster_modulation_as_it_is) {
    for (const double hz : {8.0, 12.0, 25.0}) {
        const std::vector<double> x = swung(gaussian(2), hz);
        EXPECT_NEAR(level_deviation_db(levelled(x), kRate), level_deviation_db(x, kRate), 0.1) << hz;
    }
}

TEST(SlowLevel, of_clicks_at_random_places_is_none) {
    for (const double per_s : {30.0, 100.0, 300.0}) {
        std::vector<double> x = gaussian(3);
        std::mt19937_64 random(4);
        std::exponential_distribution<double> gap(per_s / kRate);
        for (double at = gap(random); at < static_cast<double>(x.size()); at += gap(random)) {
            x[static_cast<std::size_t>(at)] += 2;
        }
        const std::vector<double> y = levelled(x);
        EXPECT_LT(gain_range_db(x, y), 2) << per_s;
        EXPECT_NEAR(kurtosis(y) / kurtosis(x), 1, 0.05) << per_s;
    }
}

TEST(SlowLevel, of_a_hand_over_clicks_is_the_hands_alone) {
    std::vector<double> plain = gaussian(5);
    std::mt19937_64 random(6);
    std::exponential_distribution<double> gap(100 / kRate);
    for (double at = gap(random); at < static_cast<double>(plain.size()); at += gap(random)) {
        plain[static_cast<std::size_t>(at)] += 1;
    }
    const std::vector<double> x = swung(plain, 1.5);
    EXPECT_GT(kurtosis(x), 1.4 * kurtosis(plain));
    EXPECT_NEAR(kurtosis(levelled(x)) / kurtosis(plain), 1, 0.1);
}

TEST(SlowLevel, of_little_sound_or_of_silence_is_nothing_to_stumble_over) {
    const std::vector<double> nothing, little(300, 0.1), silence(44100);
    const std::span<const double> pieces[] = {nothing, little, silence};
    const auto out = without_slow_level(pieces, kRate);
    ASSERT_EQ(out.size(), 3u);
    EXPECT_TRUE(out[0].empty());
    EXPECT_EQ(out[1], little);
    EXPECT_EQ(out[2], silence);
}

}  // namespace
}  // namespace tribo::noise
