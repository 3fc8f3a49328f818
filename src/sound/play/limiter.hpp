// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace tribo::sound {

// Knee of the limiter, relative to full scale. Samples below it are unchanged. At 0 dB gain only cuts whose
// harmonics have a sum above 750 N reach it.
inline constexpr double kLimiterKnee = 0.75;

// Memoryless soft limiter: x up to the knee k; above it k + (1 - k) z / (1 + z) with z = (|x| - k) / (1 - k).
// The slope is continuous and the result stays below 1. It distorts (twice full scale gives 0.958) but needs
// no look-ahead and does not pump.
inline double soft_limit(double x) {
    const double size = std::abs(x);
    if (size <= kLimiterKnee) return x;
    if (size != size) return 0;
    const double z = (size - kLimiterKnee) / (1 - kLimiterKnee);
    // z / (1 + z), in a form that is valid for an infinite z.
    const double y = 1 - (1 - kLimiterKnee) / (1 + z);
    return x < 0 ? -y : y;
}

}  // namespace tribo::sound
