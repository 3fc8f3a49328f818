// SPDX-License-Identifier: MIT
// The frame of a program's coordinates, shifted and turned in the stock.
#pragma once

#include "base/vec3.hpp"
#include "motion/algebra/direction.hpp"

namespace tribo::motion {

struct WorkFrame {
    Vec3 origin_mm;
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // unit, right-handed

    Vec3 direction_in_stock(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
    Vec3 in_stock(Vec3 p) const { return origin_mm + direction_in_stock(p); }
    Vec3 direction_from_stock(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
    Vec3 from_stock(Vec3 p) const { return direction_from_stock(p - origin_mm); }
    bool is_tilted() const { return z != Vec3{0, 0, 1}; }

    // Returns this frame shifted by `by` in its own coordinates.
    WorkFrame shifted(Vec3 by) const { return {in_stock(by), x, y, z}; }
    // Returns this frame turned right-handed about a direction given in its own coordinates.
    WorkFrame turned(Vec3 about, double turn_rad) const {
        const Vec3 axis = direction_in_stock(about);
        return {origin_mm, motion::turned(x, axis, turn_rad), motion::turned(y, axis, turn_rad),
                motion::turned(z, axis, turn_rad)};
    }
};

}  // namespace tribo::motion
