// SPDX-License-Identifier: MIT
// Where the tool stands, and how it travels there.
#pragma once

#include <cmath>

#include "milling/force/edge_force.hpp"
#include "milling/tool/tool_frame.hpp"

namespace tribo::milling {

// `travel` is that over a row, say: only the ratios count where material is looked for.
struct CutPose {
    Vec3 tip_mm;
    ToolFrame frame;
    ToolTravel travel;

    Vec3 on_axis(double height_mm) const { return tip_mm + height_mm * frame.z; }
};

// The rotations at which a place of the envelope of a cutter `length_mm` long moves outward by more than
// rounding.
inline TurnWindow moving_outward(const CutPose& pose, const ProfilePoint& at, double length_mm) {
    constexpr double kOutward = 1e-7;
    const ToolTravel& t = pose.travel;
    const double way =
        t.across_mm + std::abs(t.down_mm) + length_mm * (std::abs(t.turn_x_rad) + std::abs(t.turn_y_rad));
    return window_above(normal_travel(t, at), kOutward * way);
}

}  // namespace tribo::milling
