// SPDX-License-Identifier: MIT
// Random displacements and poses for property tests: spread evenly, from RapidCheck's integers so that
// failing cases shrink.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "motion/algebra/dual_quaternion.hpp"

namespace tribo::motion::testing {

// In -range..range in steps of range / 10^6.
inline double real(double range) {
    return range * 1e-6 * *rc::gen::inRange(-1000000, 1000001);
}
inline Vec3 vector(double range) {
    const double x = real(range), y = real(range), z = real(range);
    return {x, y, z};
}
inline Vec3 direction() {
    return normalized(vector(1));
}
inline Quaternion rotation() {
    const double w = real(1);
    return normalized(Quaternion(w, vector(1)));
}
inline DualQuaternion unit() {
    const Quaternion q = rotation();
    return displacement(q, vector(100));
}
inline DualQuaternion any_dual_quaternion() {
    const double a = real(3), b = real(3);
    const Vec3 u = vector(3), v = vector(3);
    return {Quaternion(a, u), Quaternion(b, v)};
}
inline ToolPose pose(double range_mm) {
    const Vec3 tip = vector(range_mm);
    return {tip, direction()};
}

inline double size(const DualQuaternion& q) {
    return std::max(norm(q.real), norm(q.dual));
}
inline double gap(const DualQuaternion& a, const DualQuaternion& b) {
    return size(a - b);
}
// Of two displacements, whatever sign and scale they come with: how far a point 50 mm out is moved apart.
inline double displacement_gap_mm(const DualQuaternion& a, const DualQuaternion& b) {
    double most = 0;
    for (const Vec3 p : {Vec3{50, 0, 0}, Vec3{0, 50, 0}, Vec3{0, 0, 50}})
        most = std::max(most, distance(transform_point(a, p), transform_point(b, p)));
    return most;
}

}  // namespace tribo::motion::testing
