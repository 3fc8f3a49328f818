// SPDX-License-Identifier: MIT
// Numbers that are drawn at random, the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>

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
    Vec3 aside(double most) { return {between(-most, most), between(-most, most), 0}; }

  private:
    CounterNoise noise_;
    std::uint64_t next_;
};

}  // namespace tribo::test
