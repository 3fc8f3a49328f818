// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace tribo::sound {

// What no cut reaches at 0 dB of gain unless its harmonics add up to 750 N: below this share of full scale
// the limiter changes no bit.
inline constexpr double kLimiterKnee = 0.75;

// Soft limit without memory: x up to the knee k; beyond, k + (1 - k) z / (1 + z) with z = (|x| - k) / (1 -
// k), which goes on with slope 1 and never passes 1. It bends the wave (twice full scale comes out as 0.958)
// but needs no look-ahead and never pumps.
inline double limited(double x) {
    const double size = std::abs(x);
    if (size <= kLimiterKnee) return x;
    if (size != size) return 0;
    const double z = (size - kLimiterKnee) / (1 - kLimiterKnee);
    // z / (1 + z), in the form that an infinite z survives.
    const double y = 1 - (1 - kLimiterKnee) / (1 + z);
    return x < 0 ? -y : y;
}

}  // namespace tribo::sound
