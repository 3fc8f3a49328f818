// SPDX-License-Identifier: MIT
// Quaternions w + x i + y j + z k with Hamilton's product. A unit quaternion q turns v into q v q*.
// Header only, + - * / sqrt only; any thread. Source: Bottema & Roth 1990, Theoretical Kinematics, ch. XIII.
#pragma once

#include <cmath>

#include "base/vec3.hpp"

namespace tribo::motion {

struct Quaternion {
    double w = 0, x = 0, y = 0, z = 0;

    constexpr Quaternion() = default;
    constexpr Quaternion(double scalar, double i, double j, double k) : w(scalar), x(i), y(j), z(k) {}
    constexpr Quaternion(double scalar, Vec3 v) : w(scalar), x(v.x), y(v.y), z(v.z) {}

    constexpr Vec3 vector() const { return {x, y, z}; }
    constexpr bool operator==(const Quaternion&) const = default;
};

inline constexpr Quaternion kIdentityQuaternion{1, 0, 0, 0};

constexpr Quaternion operator+(Quaternion a, Quaternion b) {
    return {a.w + b.w, a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Quaternion operator-(Quaternion a, Quaternion b) {
    return {a.w - b.w, a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Quaternion operator-(Quaternion a) {
    return {-a.w, -a.x, -a.y, -a.z};
}
constexpr Quaternion operator*(double s, Quaternion a) {
    return {s * a.w, s * a.x, s * a.y, s * a.z};
}
constexpr Quaternion operator*(Quaternion a, Quaternion b) {
    return {a.w * b.w - dot(a.vector(), b.vector()),
            a.w * b.vector() + b.w * a.vector() + cross(a.vector(), b.vector())};
}
constexpr Quaternion conjugate(Quaternion a) {
    return {a.w, -a.x, -a.y, -a.z};
}
constexpr double dot(Quaternion a, Quaternion b) {
    return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double norm(Quaternion a) {
    return std::sqrt(dot(a, a));
}
// a / |a|; zero gives the identity.
inline Quaternion normalized(Quaternion a) {
    const double n = norm(a);
    return n > 0 ? (1 / n) * a : kIdentityQuaternion;
}

// Returns v turned by q of any norm > 0: q v q* / |q|^2.
constexpr Vec3 rotate(Quaternion q, Vec3 v) {
    return (q * Quaternion(0, v) * conjugate(q)).vector() / dot(q, q);
}

// Returns the unit quaternion of the smallest turn from the unit vector `from` to the unit vector `to`, with
// w >= 0. Opposite vectors turn about any_perpendicular(from).
inline Quaternion minimal_rotation(Vec3 from, Vec3 to) {
    // Half-angle form: |from + to| = 2 cos(a / 2), |from - to| = 2 sin(a / 2), |from x to| = sin a.
    const Vec3 sum = from + to;
    const double twice_cosine = length(sum);
    if (twice_cosine > 0.1) return normalized(Quaternion(0.5 * twice_cosine, cross(from, to) / twice_cosine));
    // Near opposite, the cross product is mostly rounding. Made perpendicular to the difference, it still
    // gives a turn that ends at `to` to rounding.
    const Vec3 difference = from - to;
    const Vec3 along = normalized(difference);
    const Vec3 rough = normalized(cross(from, to), any_perpendicular(along));
    const Vec3 axis = normalized(rough - dot(rough, along) * along, any_perpendicular(along));
    return normalized(Quaternion(0.5 * twice_cosine, 0.5 * length(difference) * axis));
}

}  // namespace tribo::motion
