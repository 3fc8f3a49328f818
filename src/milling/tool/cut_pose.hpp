// SPDX-License-Identifier: MIT
// Pose and travel of the tool at one place of a cut.
#pragma once

#include <cmath>

#include "milling/force/edge_force.hpp"
#include "milling/tool/tool_frame.hpp"

namespace tribo::milling {

// `travel` may be the travel of a row, for example: the search for material uses only the ratios of its
// values.
struct CutPose {
    Vec3 tip_mm;
    ToolFrame frame;
    ToolTravel travel;

    Vec3 on_axis(double height_mm) const { return tip_mm + height_mm * frame.z; }
};

// Returns the rotations at which a point of the envelope moves outward by more than rounding. The cutter is
// `length_mm` long.
inline TurnWindow moving_outward(const CutPose& pose, const ProfilePoint& at, double length_mm) {
    constexpr double kOutward = 1e-7;
    const ToolTravel& t = pose.travel;
    const double way =
        t.across_mm + std::abs(t.down_mm) + length_mm * (std::abs(t.turn_x_rad) + std::abs(t.turn_y_rad));
    return window_above(normal_travel(t, at), kOutward * way);
}

}  // namespace tribo::milling
