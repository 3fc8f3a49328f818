// SPDX-License-Identifier: MIT
// Motions for tests, and what tests ask of a motion: its pieces, its rates, all its moves.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "motion/curve/bspline_motion.hpp"
#include "motion/path/moves.hpp"

namespace tribo::motion::testing {

// Makes a motion from unit dual quaternions and one weight > 0 each. Q and -Q are one displacement but two
// control points: each gets the sign that brings it nearer to the one before.
inline BezierMotion weighted_motion(std::span<const DualQuaternion> units, std::span<const double> weights) {
    BezierMotion motion;
    for (std::size_t i = 0; i < units.size(); ++i) {
        const bool flip = i > 0 && dot(motion.control.back().real, units[i].real) < 0;
        motion.control.push_back((flip ? -weights[i] : weights[i]) * units[i]);
    }
    return motion;
}

inline std::vector<MotionPiece> bezier_pieces(const BSplineMotion& motion) {
    const BSpline<DualQuaternion>& s = motion.spline;
    std::vector<MotionPiece> pieces;
    for (std::size_t k = s.degree; k < s.control.size(); ++k)
        if (s.knots[k] != s.knots[k + 1]) pieces.push_back(bezier_piece(motion, k));
    return pieces;
}

// Returns the whole motion as moves with the words of `like`.
inline std::vector<Move> to_moves(const BSplineMotion& motion, const Move& like,
                                  const PieceTolerance& tolerance = {}) {
    std::vector<Move> moves;
    append_moves(motion, motion.start(), motion.end(), like, tolerance,
                 std::numeric_limits<std::size_t>::max(), moves);
    return moves;
}

// Returns the derivative by u, one degree lower.
template <class T>
BSpline<T> derivative(const BSpline<T>& s) {
    BSpline<T> r{s.degree - 1, {s.knots.begin() + 1, s.knots.end() - 1}, {}};
    for (std::size_t i = 0; i + 1 < s.control.size(); ++i) {
        const double width = s.knots[i + s.degree + 1] - s.knots[i + 1];
        r.control.push_back((static_cast<double>(s.degree) / width) *
                            (s.control[i + 1] + (-1.0) * s.control[i]));
    }
    return r;
}

// Pose of the tool and its rate per unit of the motion's parameter (mm, and the change of the axis in rad).
struct PoseRates {
    ToolPose pose;
    Vec3 tip_rate_mm, axis_rate;
};

// For the displacement Q with the parameter derivative `rate`; Q of any norm > 0.
inline PoseRates pose_rates(const DualQuaternion& q, const DualQuaternion& rate) {
    const double n = dot(q.real, q.real), n_rate = 2 * dot(q.real, rate.real);
    const Quaternion along_axis(0, 0, 0, 1);
    const Vec3 tip = 2.0 / n * (q.dual * conjugate(q.real)).vector();
    const Vec3 moved = 2.0 * (rate.dual * conjugate(q.real) + q.dual * conjugate(rate.real)).vector();
    const Vec3 axis = (q.real * along_axis * conjugate(q.real)).vector() / n;
    // The two halves of (q k q*)' are conjugate to each other except for the sign: their vector parts are
    // equal.
    const Vec3 turned = 2.0 * (rate.real * along_axis * conjugate(q.real)).vector();
    return {{tip, normalized(axis)}, (moved - n_rate * tip) / n, (turned - n_rate * axis) / n};
}
inline PoseRates rates(const BezierMotion& motion, double t) {
    return pose_rates(motion.at(t), de_casteljau(derivative(motion.control), t));
}
inline PoseRates rates(const BSplineMotion& motion, double u) {
    return pose_rates(motion.at(u), evaluate(derivative(motion.spline), u));
}

}  // namespace tribo::motion::testing
