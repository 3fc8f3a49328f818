// SPDX-License-Identifier: MIT
// Rational B-spline motions: B-splines in the space of dual quaternions, and their conversion to Bezier
// motions. Where the knots make the curve C2, tip and axis move C2. Any thread. Source: Ge & Ravani 1994,
// J. Mech. Des. 116; Juttler & Wagner 1996, J. Mech. Des. 118.
#pragma once

#include <vector>

#include "motion/curve/bezier_motion.hpp"
#include "motion/curve/bspline.hpp"

namespace tribo::motion {

struct BSplineMotion {
    BSpline<DualQuaternion> spline;  // is_valid(spline); the real part is nowhere zero

    std::size_t degree() const { return spline.degree; }
    double start() const { return spline.start(); }
    double end() const { return spline.end(); }
    DualQuaternion at(double u) const { return evaluate(spline, u); }
    ToolPose pose(double u) const { return tool_pose(at(u)); }
};

// The piece between two neighbouring knots; its motion runs over 0..1.
struct MotionPiece {
    double start = 0, end = 1;
    BezierMotion motion;
};
// Returns the piece over span k of the spline, knots[k] < knots[k + 1].
MotionPiece bezier_piece(const BSplineMotion& motion, std::size_t k);

// Returns the motion whose tip runs along `tip` while it turns by `rotation`. Both are splines of one degree
// n over the same knots, with w > 0 and a rotation that is nowhere zero. The result has degree 2 n and their
// smoothness; exact.
BSplineMotion motion_along(const BSpline<HomogeneousPoint>& tip, const BSpline<Quaternion>& rotation);

}  // namespace tribo::motion
