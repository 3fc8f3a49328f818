// SPDX-License-Identifier: MIT
#include "motion/curve/bspline_motion.hpp"

#include <algorithm>
#include <utility>

namespace tribo::motion {

PoseRates BSplineMotion::rates(double u) const {
    return pose_rates(at(u), evaluate(derivative(spline), u));
}

BSplineMotion with_knot(const BSplineMotion& motion, double u) {
    return {with_knot(motion.spline, u)};
}

BSplineMotion elevated(const BSplineMotion& motion) {
    return {elevated(motion.spline)};
}

MotionPiece bezier_piece(const BSplineMotion& motion, std::size_t k) {
    BezierPiece<DualQuaternion> piece = bezier_piece(motion.spline, k);
    return {piece.start, piece.end, {std::move(piece.control)}};
}

std::vector<MotionPiece> bezier_pieces(const BSplineMotion& motion) {
    std::vector<MotionPiece> pieces;
    for (BezierPiece<DualQuaternion>& piece : bezier_pieces(motion.spline))
        pieces.push_back({piece.start, piece.end, {std::move(piece.control)}});
    return pieces;
}

BSpline<HomogeneousPoint> point_path(const BSplineMotion& motion, Vec3 point_in_tool_mm) {
    const HomogeneousPoint p{point_in_tool_mm, 1};
    return spline_product(motion.spline, motion.spline,
                          [&](const DualQuaternion& a, const DualQuaternion& b) { return image(a, b, p); });
}

BSplineMotion motion_along(const BSpline<HomogeneousPoint>& tip, const BSpline<Quaternion>& rotation) {
    return {spline_product(tip, rotation, [](const HomogeneousPoint& p, const Quaternion& q) {
        return DualQuaternion{p.w * q, 0.5 * (Quaternion(0, p.xyz) * q)};
    })};
}

double norm_margin(const BSplineMotion& motion) {
    double margin = 1;
    for (const MotionPiece& piece : bezier_pieces(motion))
        margin = std::min(margin, norm_margin(piece.motion));
    return margin;
}

}  // namespace tribo::motion
