// SPDX-License-Identifier: MIT
// Numbers that are drawn at random, the same on every machine.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/math.hpp"
#include "base/noise_hash.hpp"
#include "base/vec3.hpp"

namespace tribo::test {

// Each scene of a seed draws its own.
class Draw {
  public:
    Draw(std::uint64_t seed, std::uint64_t scene) : noise_(seed), next_(scene << 32U) {}
    double between(double low, double high) { return low + (high - low) * noise_.uniform(next_++); }
    bool by_chance(double share) { return between(0, 1) < share; }
    template <class T, std::size_t kCount>
    T one_of(const T (&all)[kCount]) {
        return all[static_cast<std::size_t>(between(0, kCount))];
    }
    // In a square about 0, and between two heights: two draws in one sum have no order.
    Vec3 aside(double most) { return {between(-most, most), between(-most, most), 0}; }
    Vec3 aside(double most, double low, double high) {
        return {between(-most, most), between(-most, most), between(low, high)};
    }
    // Unit, all alike.
    Vec3 direction() {
        const double z = between(-1, 1), u = between(0, math::kTwoPi), r = std::sqrt(1 - z * z);
        return {r * math::cos(u), r * math::sin(u), z};
    }

  private:
    CounterNoise noise_;
    std::uint64_t next_;
};

}  // namespace tribo::test
