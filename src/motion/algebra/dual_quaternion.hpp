// SPDX-License-Identifier: MIT
// Dual quaternions q + e d, e^2 = 0: rigid displacements as points of a space of eight numbers. Freeform
// motions are built from them. A unit dual quaternion (|q| = 1, q.d = 0) turns by q and then moves by t = 2 d
// q*, in mm. Any dual quaternion with q != 0 also represents a displacement; only the vector part of t
// counts. Q and s Q are the same displacement for a real s != 0; therefore weighted curves are rational
// motions. No allocation; any thread. Sources: Bottema & Roth 1990, Theoretical Kinematics, ch. XIII; Ge &
// Ravani 1991, J. Mech. Des. 113 (dual quaternion curves).
#pragma once

#include <span>
#include <vector>

#include "motion/algebra/quaternion.hpp"
#include "motion/path/program.hpp"

namespace tribo::motion {

struct DualQuaternion {
    Quaternion real, dual;
    constexpr bool operator==(const DualQuaternion&) const = default;
};

inline constexpr DualQuaternion kIdentityDisplacement{kIdentityQuaternion, {}};

constexpr DualQuaternion operator+(const DualQuaternion& a, const DualQuaternion& b) {
    return {a.real + b.real, a.dual + b.dual};
}
constexpr DualQuaternion operator-(const DualQuaternion& a, const DualQuaternion& b) {
    return {a.real - b.real, a.dual - b.dual};
}
constexpr DualQuaternion operator-(const DualQuaternion& a) {
    return {-a.real, -a.dual};
}
constexpr DualQuaternion operator*(double s, const DualQuaternion& a) {
    return {s * a.real, s * a.dual};
}
// The product is the displacement b followed by a.
constexpr DualQuaternion operator*(const DualQuaternion& a, const DualQuaternion& b) {
    return {a.real * b.real, a.real * b.dual + a.dual * b.real};
}

// Returns the displacement that first turns, then translates. `rotation` is unit.
constexpr DualQuaternion displacement(Quaternion rotation, Vec3 translation_mm) {
    return {rotation, 0.5 * (Quaternion(0, translation_mm) * rotation)};
}
// Returns t of the displacement, for any Q with q != 0.
constexpr Vec3 translation_mm(const DualQuaternion& a) {
    return 2.0 / dot(a.real, a.real) * (a.dual * conjugate(a.real)).vector();
}
// Return the image of a point and of a direction, for any Q with q != 0.
constexpr Vec3 transform_point(const DualQuaternion& a, Vec3 p) {
    return rotate(a.real, p) + translation_mm(a);
}
constexpr Vec3 transform_direction(const DualQuaternion& a, Vec3 v) {
    return rotate(a.real, v);
}

// Returns the pose of a tool with its tip at the origin and its axis along +z in its own frame.
ToolPose tool_pose(const DualQuaternion& a);

// A pose does not define the turn about the tool axis; it has no effect on a cutter of revolution. Here the
// frame takes the smallest turn from +z to the axis.
DualQuaternion displacement(const ToolPose& pose);
// Here each frame takes the smallest turn from the frame before (parallel transport along the axis path): the
// frame never twists about the axis and neighbours lie in one hemisphere: q_i . q_i+1 >= 0. All unit.
std::vector<DualQuaternion> minimal_twist_displacements(std::span<const ToolPose> poses);

}  // namespace tribo::motion
