// SPDX-License-Identifier: MIT
// Directions on the unit sphere: the angle between two, and the great circle from one to the other.
// No allocation; any thread.
#pragma once

#include "base/vec3.hpp"

namespace tribo::motion {

// Returns the angle between two vectors of any length, 0..pi rad, with full accuracy also near 0 and pi. 0 if
// one is zero.
double angle_rad(Vec3 a, Vec3 b);

// Returns v turned about the unit vector `about` by `turn_rad`, right-handed (Rodrigues).
Vec3 turned(Vec3 v, Vec3 about, double turn_rad);

// Returns the unit vector at the fraction t of the great circle from the unit vector a to the unit vector b,
// at constant angular speed. Between opposite directions the path goes through any_perpendicular(a).
Vec3 slerp(Vec3 a, Vec3 b, double t);

// Returns v turned by the shortest rotation of +z to a unit axis. To -z: the half turn about x.
Vec3 turned_upright(Vec3 v, Vec3 axis);

}  // namespace tribo::motion
