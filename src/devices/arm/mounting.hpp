// SPDX-License-Identifier: MIT
// Mounting of an arm: rotation from its axes to the axes of the stock, and position of its zero.
#pragma once

#include "base/vec3.hpp"

namespace tribo::devices {

// The user sits at -y of the stock and looks along +y; up is +z. x, y, z are the axes of the arm in the stock
// frame.
struct Axes {
    Vec3 x, y, z;
    Vec3 to_stock(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
    Vec3 from_stock(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};
// 3D Systems and Haply: x right, y up, z towards the user. (The base of the Inverse3 has z up: see below.)
inline constexpr Axes kRightUpNear{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
// Force Dimension: x towards the user, y right, z up.
inline constexpr Axes kNearRightUp{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
// Inverse3: x right, y away from the user, z up, as the stock.
inline constexpr Axes kRightAwayUp{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

struct Mounting {
    Vec3 origin_mm;    // zero of the arm, stock frame
    double scale = 1;  // millimetres in the stock per millimetre of the hand, > 0
};

}  // namespace tribo::devices
