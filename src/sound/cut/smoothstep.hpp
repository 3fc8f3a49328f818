// SPDX-License-Identifier: MIT
// A smooth way from 0 at x = 0 to 1 at x = 1; constant outside.
#pragma once

#include <algorithm>

namespace tribo::sound {

inline double smoothstep(double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

}  // namespace tribo::sound
