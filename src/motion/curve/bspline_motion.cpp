// SPDX-License-Identifier: MIT
#include "motion/curve/bspline_motion.hpp"

#include <algorithm>
#include <utility>

namespace tribo::motion {

MotionPiece bezier_piece(const BSplineMotion& motion, std::size_t k) {
    BezierPiece<DualQuaternion> piece = bezier_piece(motion.spline, k);
    return {piece.start, piece.end, {std::move(piece.control)}};
}

BSplineMotion motion_along(const BSpline<HomogeneousPoint>& tip, const BSpline<Quaternion>& rotation) {
    return {spline_product(tip, rotation, [](const HomogeneousPoint& p, const Quaternion& q) {
        return DualQuaternion{p.w * q, 0.5 * (Quaternion(0, p.xyz) * q)};
    })};
}

}  // namespace tribo::motion
