// SPDX-License-Identifier: MIT
// Rational Bezier motions: Bezier curves in the space of dual quaternions, used as moving displacements. The
// size of a control dual quaternion is its weight. Under a motion of degree n every point of the tool moves
// on a rational Bezier curve of degree 2 n. This file gives its exact control points, and those of the curve
// of every direction. Any thread. Sources: Ge & Ravani 1991, J. Mech. Des. 113, and 1994, J. Mech. Des. 116
// (Bezier motions); Juttler & Wagner 1996, J. Mech. Des. 118 (rational motions of degree 2 n).
#pragma once

#include <span>
#include <vector>

#include "motion/algebra/dual_quaternion.hpp"
#include "motion/curve/bezier.hpp"

namespace tribo::motion {

// A point (xyz / w, mm) of a rational curve, or a direction of any length (w is only its scale).
struct HomogeneousPoint {
    Vec3 xyz;
    double w = 0;

    constexpr Vec3 point() const { return xyz / w; }
    constexpr bool operator==(const HomogeneousPoint&) const = default;
};
constexpr HomogeneousPoint operator+(HomogeneousPoint a, HomogeneousPoint b) {
    return {a.xyz + b.xyz, a.w + b.w};
}
constexpr HomogeneousPoint operator*(double s, HomogeneousPoint a) {
    return {s * a.xyz, s * a.w};
}

struct BezierMotion {
    std::vector<DualQuaternion> control;  // degree + 1, over 0..1; the real part of the curve is nowhere zero

    std::size_t degree() const { return control.size() - 1; }
    DualQuaternion at(double t) const { return de_casteljau(control, t); }
    ToolPose pose(double t) const { return tool_pose(at(t)); }
};

std::pair<BezierMotion, BezierMotion> subdivide(const BezierMotion& motion, double t);

// The bilinear form behind the exact paths: for a = b = Q it is the image of the homogeneous point under Q,
// with weight |Q|^2 w.
HomogeneousPoint image(const DualQuaternion& a, const DualQuaternion& b, HomogeneousPoint p);

// Returns the 2 n + 1 control points of the path of the homogeneous point p of the tool: a rational Bezier
// curve over 0..1, exact.
std::vector<HomogeneousPoint> point_path(const BezierMotion& motion, HomogeneousPoint p);
std::vector<HomogeneousPoint> point_path(const BezierMotion& motion, Vec3 point_in_tool_mm);
// The same for a direction of the tool: xyz / w is its image, of the same length.
std::vector<HomogeneousPoint> direction_path(const BezierMotion& motion, Vec3 direction_in_tool);

// Returns the smallest Bernstein coefficient of |q|^2 over the largest. A value > 0 proves that the motion
// has no pole.
double norm_margin(const BezierMotion& motion);
// Returns true if |q|^2 comes so near to zero (1e-9 of the largest) that the motion runs to infinity; by
// subdivision.
bool has_pole(const BezierMotion& motion);

}  // namespace tribo::motion
