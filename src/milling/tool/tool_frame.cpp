// SPDX-License-Identifier: MIT
#include "milling/tool/tool_frame.hpp"

namespace tribo::milling {

ToolFrame tool_frame(Vec3 axis, Vec3 travel, Vec3 last_x) {
    const Vec3 across = travel - dot(travel, axis) * axis;
    // Below this share of the travel the direction across the axis is rounding.
    constexpr double kPlunge = 1e-6;
    ToolFrame f;
    f.z = axis;
    if (length(across) > kPlunge * length(travel)) {
        f.x = normalized(across);
    } else {
        const Vec3 last = last_x - dot(last_x, axis) * axis;
        f.x = normalized(last, any_perpendicular(axis));
    }
    f.y = cross(f.z, f.x);
    return f;
}

}  // namespace tribo::milling
