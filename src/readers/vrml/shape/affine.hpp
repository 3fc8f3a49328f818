// SPDX-License-Identifier: MIT
// Placements of VRML nodes.
#pragma once

#include "base/math.hpp"
#include "base/vec3.hpp"

namespace tribo::readers {

// x -> linear * x + offset; the linear part is stored by columns.
struct Affine {
    Vec3 column[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3 offset;

    Vec3 turn(Vec3 p) const { return p.x * column[0] + p.y * column[1] + p.z * column[2]; }
    Vec3 operator()(Vec3 p) const { return turn(p) + offset; }
    Affine operator*(const Affine& inner) const {
        return {{turn(inner.column[0]), turn(inner.column[1]), turn(inner.column[2])}, (*this)(inner.offset)};
    }
    bool mirrors() const { return dot(cross(column[0], column[1]), column[2]) < 0; }
};

// Rotation about an axis through the origin (Rodrigues). A zero axis gives no rotation.
inline Affine rotation(Vec3 axis, double angle_rad) {
    const Vec3 u = normalized(axis, {});
    if (u == Vec3{}) return {};
    double s = 0, c = 1;
    math::sincos(angle_rad, s, c);
    const auto turned = [&](Vec3 p) { return c * p + s * cross(u, p) + (1 - c) * dot(u, p) * u; };
    return {{turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})}, {}};
}

}  // namespace tribo::readers
