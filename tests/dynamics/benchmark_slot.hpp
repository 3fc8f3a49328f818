// SPDX-License-Identifier: MIT
// The benchmark of the literature: two teeth, one mode along the feed (Insperger and Stepan 2004).
#pragma once

#include "base/math.hpp"
#include "dynamics/mode.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::dynamics {

inline const milling::Cutter kCutter{.diameter_mm = 10, .flutes = 2, .helix_deg = 0};
inline constexpr milling::CuttingCoefficients kAluminium{600, 200, 0, 0, 0, 0};

inline Mode benchmark_mode(Vec3 direction = {1, 0, 0}) {
    constexpr double kMassKg = 0.03993, kHz = 922;
    constexpr double w = math::kTwoPi * kHz;
    return {direction, kHz, 0.011, 1e-3 * kMassKg * w * w};
}

}  // namespace tribo::dynamics
