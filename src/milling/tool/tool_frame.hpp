// SPDX-License-Identifier: MIT
// The tool's frame (README of this room, "Frame"): x along the feed, y to its left, z to the shank.
#pragma once

#include "base/vec3.hpp"

namespace tribo::milling {

struct ToolFrame {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    Vec3 in_stock(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }  // converts a vector from this frame
};

// Returns the frame for an axis and a direction of travel. A plunge has no feed direction across the axis.
// Then `last_x`, projected on the plane normal to the axis, is used instead.
ToolFrame tool_frame(Vec3 axis, Vec3 travel, Vec3 last_x);

}  // namespace tribo::milling
