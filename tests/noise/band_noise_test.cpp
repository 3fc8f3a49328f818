// SPDX-License-Identifier: MIT
#include "noise/play/band_noise.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace tribo::noise {
namespace {

std::vector<double> rendered(BandNoise& noise, std::uint64_t first, std::size_t length) {
    std::vector<double> out(length);
    noise.render(first, out);
    return out;
}

// Mean power at one frequency over stretches of 480 samples under a Hann window; arbitrary scale.
double power_at(const std::vector<double>& x, double cycles_per_sample) {
    constexpr int kStretch = 480;
    double power = 0;
    std::size_t count = 0;
    for (std::size_t begin = 0; begin + kStretch <= x.size(); begin += kStretch, ++count) {
        std::complex<double> sum = 0;
        for (std::size_t n = 0; n < kStretch; ++n) {
            const double hann =
                1 - std::cos(2 * std::numbers::pi * (static_cast<double>(n) + 0.5) / kStretch);
            sum += hann * x[begin + n] *
                   std::polar(1.0, -2 * std::numbers::pi * cycles_per_sample * static_cast<double>(n));
        }
        power += std::norm(sum);
    }
    return power / static_cast<double>(count);
}

TEST(BandNoise, has_a_mean_square_of_one_and_no_mean_at_any_rate) {
    for (const double rate : {44100.0, 48000.0, 96000.0}) {
        BandNoise noise(7, rate);
        double sum = 0, energy = 0;
        const std::vector<double> x = rendered(noise, 0, 960000);
        for (const double v : x) {
            sum += v;
            energy += v * v;
        }
        EXPECT_NEAR(energy / static_cast<double>(x.size()), 1, 0.01) << rate;
        EXPECT_NEAR(sum / static_cast<double>(x.size()), 0, 1e-3) << rate;
    }
}

// The analogue second-order Butterworth: 1 / (1 + (f / fc)^4), the bilinear transform's frequency
// w = tan(pi f / rate) in place of f.
TEST(BandNoise, falls_by_3_dB_at_its_ends_and_12_dB_per_octave_beyond) {
    constexpr double kRate = 48000;
    BandNoise noise(3, kRate);
    const std::vector<double> x = rendered(noise, 0, 960000);
    const double reference = power_at(x, 3000 / kRate);
    const auto w = [](double hz) { return std::tan(std::numbers::pi * hz / kRate); };
    const auto expected = [&](double hz) {
        return 1 / (1 + std::pow(w(1000) / w(hz), 4)) / (1 + std::pow(w(hz) / w(8000), 4));
    };
    EXPECT_NEAR(10 * std::log10(expected(1000)), -3.01, 0.01);
    for (const double hz : {400.0, 1000.0, 2000.0, 5000.0, 8000.0, 14000.0, 18000.0}) {
        EXPECT_NEAR(10 * std::log10(power_at(x, hz / kRate) / reference),
                    10 * std::log10(expected(hz) / expected(3000)), 0.6)
            << hz;
    }
}

TEST(BandNoise, gives_the_same_bits_in_any_blocks) {
    BandNoise whole(5, 48000), parts(5, 48000);
    const std::vector<double> x = rendered(whole, 0, 5000);
    std::vector<double> y(5000);
    std::size_t at = 0;
    for (std::size_t block = 1; at < y.size(); block = block * 3 % 257 + 1) {
        const std::size_t n = std::min(block, y.size() - at);
        parts.render(at, std::span(y).subspan(at, n));
        at += n;
    }
    EXPECT_EQ(x, y);
}

TEST(BandNoise, starts_anywhere_and_is_the_same_stream_once_the_start_is_forgotten) {
    BandNoise whole(5, 48000), late(5, 48000);
    const std::vector<double> x = rendered(whole, 0, 4000);
    const std::vector<double> y = rendered(late, 2000, 2000);
    for (std::size_t n = 1000; n < 2000; ++n) EXPECT_NEAR(y[n], x[2000 + n], 1e-12);
    late.clear();
    EXPECT_EQ(rendered(late, 2000, 2000), y);
}

TEST(BandNoise, of_two_seeds_is_unrelated) {
    BandNoise a(1, 48000), b(2, 48000);
    const std::vector<double> x = rendered(a, 0, 200000), y = rendered(b, 0, 200000);
    double product = 0;
    for (std::size_t n = 0; n < x.size(); ++n) product += x[n] * y[n];
    EXPECT_NEAR(product / static_cast<double>(x.size()), 0, 0.01);
}

}  // namespace
}  // namespace tribo::noise
