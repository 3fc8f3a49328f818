// SPDX-License-Identifier: MIT
// Directions spread evenly over a sphere.
#pragma once

#include <cmath>

#include "base/math.hpp"
#include "base/vec3.hpp"

namespace tribo::test {

// Number `n` of `count` unit vectors on a spiral from the bottom of the sphere up to z = `top` (Vogel 1979).
inline Vec3 spiral_direction(int n, int count, double top = 1) {
    const double z = -1 + (1 + top) * (n + 0.5) / count, turn = 2.39996322972865332 * n,
                 flat = std::sqrt(1 - z * z);
    return {flat * math::cos(turn), flat * math::sin(turn), z};
}

}  // namespace tribo::test
