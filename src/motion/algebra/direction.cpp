// SPDX-License-Identifier: MIT
#include "motion/algebra/direction.hpp"

#include "base/math.hpp"

namespace tribo::motion {

double angle_rad(Vec3 a, Vec3 b) {
    const double sine = length(cross(a, b));
    const double cosine = dot(a, b);
    return sine == 0 && cosine == 0 ? 0 : math::atan2(sine, cosine);
}

Vec3 turned(Vec3 v, Vec3 about, double turn_rad) {
    double s = 0, c = 1;
    math::sincos(turn_rad, s, c);
    return c * v + s * cross(about, v) + ((1 - c) * dot(about, v)) * about;
}

Vec3 slerp(Vec3 a, Vec3 b, double t) {
    const double angle = angle_rad(a, b);
    if (angle == 0) return a;
    const Vec3 sideways = normalized(b - dot(a, b) * a, any_perpendicular(a));
    double s = 0, c = 1;
    math::sincos(t * angle, s, c);
    return normalized(c * a + s * sideways, a);
}

Vec3 turned_upright(Vec3 v, Vec3 axis) {
    const Vec3 z{0, 0, 1}, normal = cross(z, axis);
    const double cosine = dot(z, axis);
    // Every half turn is a shortest one.
    if (cosine < -1 + 1e-12) return {v.x, -v.y, -v.z};
    return cosine * v + cross(normal, v) + (dot(normal, v) / (1 + cosine)) * normal;
}

}  // namespace tribo::motion
