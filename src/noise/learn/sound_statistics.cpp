// SPDX-License-Identifier: MIT
#include "noise/learn/sound_statistics.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>

#include "base/math.hpp"
#include "noise/model/fourier.hpp"

namespace tribo::noise {
namespace {

constexpr std::size_t kSpectrumFrame = 1024;
constexpr double kEnvelopeS = 0.002;
constexpr std::size_t kModulationFrame = 512;  // of the envelope: 1 s

double db(double power) {
    return 10 * math::log10(std::max(power, 1e-30));
}

}  // namespace

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

std::vector<double> modulation_density(std::span<const double> sound, double sample_rate_hz,
                                       std::span<const double> hz) {
    const auto frame = static_cast<std::size_t>(kEnvelopeS * sample_rate_hz);
    std::vector<double> envelope;
    double mean = 0;
    for (std::size_t at = 0; at + frame <= sound.size(); at += frame) {
        double energy = 0;
        for (std::size_t n = at; n < at + frame; ++n) energy += sound[n] * sound[n];
        envelope.push_back(std::sqrt(energy));
        mean += envelope.back();
    }
    mean /= std::max(1.0, static_cast<double>(envelope.size()));
    std::vector<double> density;
    if (!(mean > 0)) return std::vector<double>(hz.size());
    for (double& v : envelope) v = v / mean - 1;
    const std::vector<double> power =
        power_spectrum(envelope, std::min(kModulationFrame, std::bit_floor(envelope.size())));
    const double step = 0.5 / kEnvelopeS / static_cast<double>(power.size());
    for (const double f : hz) {
        double sum = 0, count = 0;
        for (std::size_t k = 0; k < power.size(); ++k) {
            const double at = step * (static_cast<double>(k) + 0.5);
            if (at < f * 0.84 || at > f * 1.19) continue;
            sum += power[k];
            ++count;
        }
        density.push_back(count > 0 ? sum / count : 0);
    }
    return density;
}

std::vector<double> power_spectrum(std::span<const double> sound, std::size_t frame) {
    assert((frame & (frame - 1)) == 0);
    std::vector<double> power(frame / 2);
    if (sound.empty()) return power;
    std::vector<double> window(std::min(sound.size(), frame));
    double weight = 0;
    for (std::size_t n = 0; n < window.size(); ++n) {
        window[n] = 0.5 - 0.5 * math::cos(math::kTwoPi * (static_cast<double>(n) + 0.5) /
                                          static_cast<double>(window.size()));
        weight += window[n] * window[n];
    }
    std::vector<std::complex<double>> x(frame);
    std::size_t count = 0;
    for (std::size_t at = 0; at + window.size() <= sound.size(); at += frame / 2, ++count) {
        std::ranges::fill(x, 0.0);
        for (std::size_t n = 0; n < window.size(); ++n) x[n] = window[n] * sound[at + n];
        fourier(x);
        for (std::size_t k = 0; k < power.size(); ++k) {
            // Half of each neighbouring line belongs to the band between them.
            power[k] += 0.5 * (std::norm(x[k]) + std::norm(x[k + 1])) / weight;
        }
    }
    for (double& p : power) p /= static_cast<double>(std::max<std::size_t>(count, 1));
    return power;
}

std::vector<double> spectrum_db(std::span<const double> sound) {
    std::vector<double> power = power_spectrum(sound, kSpectrumFrame);
    for (double& p : power) p = db(p);
    return power;
}

std::size_t shortest_of_use(std::span<const std::span<const double>> pieces, std::size_t wanted) {
    std::size_t longest = 0;
    for (const std::span<const double> piece : pieces) longest = std::max(longest, piece.size());
    return std::min(wanted, longest / 2);
}

std::vector<double> spectrum_db(std::span<const std::span<const double>> pieces) {
    std::vector<double> sum(kSpectrumFrame / 2);
    const std::size_t shortest = shortest_of_use(pieces, kSpectrumFrame);
    for (const std::span<const double> piece : pieces) {
        if (piece.size() < shortest) continue;
        const std::vector<double> power = power_spectrum(piece, kSpectrumFrame);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += static_cast<double>(piece.size()) * power[k];
    }
    for (double& p : sum) p = db(p);
    return sum;
}

std::vector<double> spectrum_hz(double sample_rate_hz) {
    constexpr std::size_t kBands = kSpectrumFrame / 2;
    std::vector<double> hz;
    for (std::size_t k = 0; k < kBands; ++k)
        hz.push_back(0.5 * sample_rate_hz * (static_cast<double>(k) + 0.5) / static_cast<double>(kBands));
    return hz;
}

std::vector<double> spectrum_db(const ArModel& model, std::span<const double> hz, double level_db) {
    std::vector<double> power;
    for (const double f : hz) power.push_back(db(power_at(model, f)) + level_db);
    return power;
}

double shape_distance_db(std::span<const double> a, std::span<const double> b, std::span<const double> hz) {
    double sum = 0, square = 0, count = 0;
    for (std::size_t n = 0; n < hz.size(); ++n) {
        if (hz[n] < 200 || hz[n] > 20000) continue;
        const double d = a[n] - b[n];
        sum += d;
        square += d * d;
        ++count;
    }
    return count > 0 ? std::sqrt(std::max(square / count - sum / count * (sum / count), 0.0)) : 0;
}

}  // namespace tribo::noise
