// SPDX-License-Identifier: MIT
#include "noise/play/pink_noise.hpp"

#include <cmath>

#include "base/math.hpp"
#include "base/noise_hash.hpp"
#include "noise/play/noise_kernels.hpp"

namespace tribo::noise {
namespace {

constexpr double kLowestPoleHz = 20, kPoleRatio = 4;

}  // namespace

PinkNoise::PinkNoise(std::uint64_t seed, double sample_rate_hz)
    : kernels_(&noise_kernels()), key_(CounterNoise(seed).bits(0)), sample_rate_hz_(sample_rate_hz) {
    double pole_hz = kLowestPoleHz;
    for (Section& s : sections_) {
        // Half way to the next pole on a logarithmic scale.
        const double zero_hz = pole_hz * std::sqrt(kPoleRatio);
        s.pole = math::exp(-math::kTwoPi * pole_hz / sample_rate_hz);
        s.zero = math::exp(-math::kTwoPi * zero_hz / sample_rate_hz);
        pole_hz *= kPoleRatio;
    }
    // The mean of the power density, by the trapezoid rule in the logarithm of frequency.
    constexpr int kSteps = 2000;
    constexpr double kLeastHz = 0.01;
    const double half_rate = 0.5 * sample_rate_hz, ratio = math::log(half_rate / kLeastHz) / kSteps;
    double power = kLeastHz * raw_power_at(0);
    for (int n = 0; n <= kSteps; ++n) {
        const double hz = kLeastHz * math::exp(ratio * n);
        power += (n == 0 || n == kSteps ? 0.5 : 1) * ratio * hz * raw_power_at(hz);
    }
    gain_ = std::sqrt(half_rate / power);
}

double PinkNoise::raw_power_at(double hz) const {
    const double cosine = math::cos(math::kTwoPi * hz / sample_rate_hz_);
    double power = 1;
    for (const Section& s : sections_) {
        power *= (1 + s.zero * (s.zero - 2 * cosine)) / (1 + s.pole * (s.pole - 2 * cosine));
    }
    return power;
}

double PinkNoise::power_at(double hz) const {
    return gain_ * gain_ * raw_power_at(hz);
}

std::span<const double, kNoiseBlock> PinkNoise::block(std::uint64_t index) {
    // Samples are numbered by 32 bits in a separate stream for each 2^26 blocks.
    constexpr std::uint64_t kBlocksPerKey = std::uint64_t{1} << 26;
    const auto key = static_cast<std::uint32_t>(CounterNoise(key_).bits(index / kBlocksPerKey) >> 32);
    std::array<float, kNoiseBlock> white;
    kernels_->gaussian(key, static_cast<std::uint32_t>(index % kBlocksPerKey * kNoiseBlock), white.data(),
                       kNoiseBlock);
    std::array<Section, kSections> s = sections_;
    for (std::size_t n = 0; n < samples_.size(); ++n) {
        double x = gain_ * static_cast<double>(white[n]);
        for (Section& section : s) {
            const double y = x - section.zero * section.in + section.pole * section.out;
            section.in = x;
            section.out = y;
            x = y;
        }
        samples_[n] = x;
    }
    sections_ = s;
    return samples_;
}

}  // namespace tribo::noise
