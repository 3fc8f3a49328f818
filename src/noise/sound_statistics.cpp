// SPDX-License-Identifier: MIT
#include "noise/sound_statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>

#include "base/math.hpp"
#include "noise/fourier.hpp"

namespace tribo::noise {

double kurtosis(std::span<const double> sound) {
    double second = 0, fourth = 0;
    for (const double v : sound) {
        second += v * v;
        fourth += v * v * v * v;
    }
    return second > 0 ? fourth * static_cast<double>(sound.size()) / (second * second) : 0;
}

std::vector<double> frame_levels_db(std::span<const double> sound, std::size_t frame) {
    std::vector<double> levels;
    for (std::size_t at = 0; at + frame <= sound.size(); at += frame) {
        double energy = 0;
        for (std::size_t n = at; n < at + frame; ++n) energy += sound[n] * sound[n];
        if (energy > 0) levels.push_back(10 * math::log10(energy / static_cast<double>(frame)));
    }
    return levels;
}

double level_deviation_db(std::span<const double> sound, double sample_rate_hz, double frame_s) {
    const std::vector<double> levels =
        frame_levels_db(sound, static_cast<std::size_t>(frame_s * sample_rate_hz));
    if (levels.empty()) return 0;
    const auto count = static_cast<double>(levels.size());
    double mean = 0, square = 0;
    for (const double l : levels) mean += l / count;
    for (const double l : levels) square += (l - mean) * (l - mean) / count;
    return std::sqrt(square);
}

double log_spectral_distance_db(const ArModel& a, const ArModel& b, double to_hz) {
    std::vector<double> difference;
    for (double hz = 200; hz <= to_hz; hz += 50) {
        difference.push_back(10 * math::log10(power_at(a, hz) / power_at(b, hz)));
    }
    const auto count = static_cast<double>(difference.size());
    double mean = 0, square = 0;
    for (const double d : difference) mean += d / count;
    for (const double d : difference) square += (d - mean) * (d - mean) / count;
    return std::sqrt(square);
}

std::vector<double> power_spectrum(std::span<const double> sound, std::size_t frame) {
    assert((frame & (frame - 1)) == 0);
    std::vector<double> window(frame), power(frame / 2);
    double weight = 0;
    for (std::size_t n = 0; n < frame; ++n) {
        window[n] =
            0.5 - 0.5 * math::cos(math::kTwoPi * (static_cast<double>(n) + 0.5) / static_cast<double>(frame));
        weight += window[n] * window[n];
    }
    std::vector<std::complex<double>> x(frame);
    std::size_t count = 0;
    for (std::size_t at = 0; at + frame <= sound.size(); at += frame / 2, ++count) {
        for (std::size_t n = 0; n < frame; ++n) x[n] = window[n] * sound[at + n];
        fourier(x);
        for (std::size_t k = 0; k < power.size(); ++k) {
            // Half of both neighbouring lines belongs to a step between them.
            power[k] += 0.5 * (std::norm(x[k]) + std::norm(x[k + 1])) / weight;
        }
    }
    for (double& p : power) p /= static_cast<double>(std::max<std::size_t>(count, 1));
    return power;
}

}  // namespace tribo::noise
