// SPDX-License-Identifier: MIT
// Points that are spread evenly over the unit disc (Vogel 1979), for soft edges without noise.
#pragma once

#include <array>
#include <cmath>

#include "base/math.hpp"
#include "base/vec3.hpp"

namespace tribo::report {

template <std::size_t kCount>
std::array<Vec3, kCount> disc_points() {
    constexpr double kGoldenAngle = 2.399963229728653;
    std::array<Vec3, kCount> points;
    for (std::size_t n = 0; n < kCount; ++n) {
        const double share = static_cast<double>(n), radius = std::sqrt((share + 0.5) / kCount);
        points[n] = {radius * math::cos(kGoldenAngle * share), radius * math::sin(kGoldenAngle * share), 0};
    }
    return points;
}

}  // namespace tribo::report
