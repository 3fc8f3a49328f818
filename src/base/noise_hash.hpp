// SPDX-License-Identifier: MIT
// White noise without state: sample n of a stream is a hash of its seed and n. So any part of it can be
// played first, or twice, with the same bits. Streams of different seeds are independent. Any thread; no
// allocation.
#pragma once

#include <cstdint>

namespace tribo {

class CounterNoise {
  public:
    constexpr explicit CounterNoise(std::uint64_t seed) : key_(mix(seed)) {}

    // 64 random bits.
    constexpr std::uint64_t bits(std::uint64_t counter) const {
        return mix(key_ + counter * 0x9e3779b97f4a7c15);
    }
    // Uniform over [0, 1), multiples of 2^-53.
    constexpr double uniform(std::uint64_t counter) const {
        return static_cast<double>(bits(counter) >> 11) * 0x1p-53;
    }
    // Mean 0, variance 1, kurtosis 3, close to Gaussian: the sum of four 16-bit numbers, shaped by the cubic
    // term of Cornish and Fisher 1938. Never beyond 4.07.
    constexpr double gaussian(std::uint64_t counter) const {
        const std::uint64_t b = bits(counter);
        const std::uint64_t sum = (b & 0xffff) + ((b >> 16) & 0xffff) + ((b >> 32) & 0xffff) + (b >> 48);
        const double z = (static_cast<double>(sum) - 2 * 65535.0) * (1.7320508075688772 / 65536);
        return z * (kLinear + kCubic * z * z);
    }

  private:
    // z is the scaled sum, with the moments 1, 2.7, 153/14, 55.8, ... For this a, a z^3 + (1 - 3 a) z has
    // kurtosis 3. The scale is one over the root of its variance.
    static constexpr double kA = 0.01854949972279291;
    static constexpr double kScale = 1.0049600395825102;
    static constexpr double kCubic = kA * kScale;
    static constexpr double kLinear = (1 - 3 * kA) * kScale;

    // The finalizer of SplitMix64 (Steele, Lea, Flood 2014), a bijection.
    static constexpr std::uint64_t mix(std::uint64_t x) {
        x += 0x9e3779b97f4a7c15;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
        x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
        return x ^ (x >> 31);
    }
    std::uint64_t key_;
};

}  // namespace tribo
