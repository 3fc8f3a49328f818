// SPDX-License-Identifier: MIT
// Interpolation between samples.
#pragma once

#include <array>

namespace tribo::dynamics {

// Weights of four values at -1, 0, 1, 2 for the cubic through them at t.
inline std::array<double, 4> cubic_weights(double t) {
    return {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
            (t + 1) * t * (t - 1) / 6};
}

}  // namespace tribo::dynamics
