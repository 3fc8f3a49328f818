// SPDX-License-Identifier: MIT
#include "readers/control/rotary_feed.hpp"

#include <cmath>

#include "base/math.hpp"

namespace tribo::readers {

RotaryFeed RotaryFeed::degrees_as_lengths(double unit_mm) {
    const double length = math::kDegPerRad * unit_mm;
    return {{length, length, length}, unit_mm};
}

double turning_time_s(double length_mm, Vec3 turn_rad, double feed_mm_per_min, const RotaryFeed& rule) {
    const Vec3 counted{rule.mm_per_rad.x * turn_rad.x, rule.mm_per_rad.y * turn_rad.y,
                       rule.mm_per_rad.z * turn_rad.z};
    const double way_mm = std::sqrt(length_mm * length_mm + dot(counted, counted));
    const double alone_mm = length(turn_rad) * math::kDegPerRad * rule.degree_mm;
    return 60 * (way_mm > 0 ? way_mm : alone_mm) / feed_mm_per_min;
}

}  // namespace tribo::readers
