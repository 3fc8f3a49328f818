// SPDX-License-Identifier: MIT
// The moving frame of an arc or helix: the basis of all arc paths of this room.
#pragma once

#include "base/math.hpp"
#include "motion/path/program.hpp"

namespace tribo::motion {

struct ArcFrame {
    Vec3 normal;     // unit
    Vec3 radial;     // mm, from the foot to the start
    Vec3 sideways;   // normal x radial: the direction of a positive turn
    Vec3 foot_mm;    // foot of the start on the line of the arc
    double rise_mm;  // along normal, over the whole move
    double radius_mm;

    // For a move that has an arc.
    explicit ArcFrame(const Move& move) : normal(normalized(move.arc->normal)) {
        const Vec3 from_centre = move.start.tip_mm - move.arc->centre_mm;
        radial = from_centre - dot(from_centre, normal) * normal;
        sideways = cross(normal, radial);
        foot_mm = move.start.tip_mm - radial;
        rise_mm = dot(move.end.tip_mm - move.start.tip_mm, normal);
        radius_mm = length(radial);
    }

    // Returns the point turned by `angle_rad`, at the fraction t of the rise.
    Vec3 at(double angle_rad, double t) const {
        double s = 0, c = 1;
        math::sincos(angle_rad, s, c);
        return foot_mm + (t * rise_mm) * normal + c * radial + s * sideways;
    }
};

}  // namespace tribo::motion
