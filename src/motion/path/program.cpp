// SPDX-License-Identifier: MIT
#include "motion/path/program.hpp"

#include <cmath>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"
#include "motion/curve/arc_frame.hpp"

namespace tribo::motion {

namespace {

// The end point of a program rarely lies on its circle to the last digit. The difference is added linearly,
// so that moves join.
Vec3 arc_point(const Move& move, const ArcFrame& frame, double t) {
    const double turn = move.arc->turn_rad;
    return frame.at(t * turn, t) + t * (move.end.tip_mm - frame.at(turn, 1));
}

Vec3 quadratic_point(Vec3 a, Vec3 control, Vec3 b, double t) {
    return lerp(lerp(a, control, t), lerp(control, b, t), t);
}

// Includes the extremes of coordinate k: angles p in 0..turn with
// d/dp [radial cos p + sideways sin p + rise p / turn] = 0.
// With many turns and a rise only the first and the last of each kind can be extreme.
void include_extremes(Box3& box, const Move& move, const ArcFrame& frame, int k) {
    const double turn = move.arc->turn_rad;
    const double c = frame.radial[k], s = frame.sideways[k];
    const double size = math::hypot(c, s);
    const double slope = frame.rise_mm * frame.normal[k] / turn;
    if (size == 0 || std::abs(slope) >= size) return;
    // s cos p - c sin p = -slope, or size cos(p + shift) = -slope
    const double shift = math::atan2(c, s), half = math::acos(-slope / size);
    const double low = std::min(0.0, turn), high = std::max(0.0, turn);
    for (const double root : {half - shift, -half - shift}) {
        const double first = root + math::kTwoPi * std::ceil((low - root) / math::kTwoPi);
        const double last = root + math::kTwoPi * std::floor((high - root) / math::kTwoPi);
        for (const double p : {first, last})
            if (p >= low && p <= high) box.include(arc_point(move, frame, p / turn));
    }
}

}  // namespace

ToolPose pose_at(const Move& move, double t) {
    if (t <= 0) return move.start;
    if (t >= 1) return move.end;
    double turn = move.start.turn_rad;
    if (move.end.turn_rad != turn) turn += t * std::remainder(move.end.turn_rad - turn, math::kTwoPi);
    if (move.quadratic) {
        const Quadratic& q = *move.quadratic;
        return {
            quadratic_point(move.start.tip_mm, q.tip_control_mm, move.end.tip_mm, t),
            normalized(quadratic_point(move.start.axis, q.axis_control, move.end.axis, t), move.start.axis),
            turn};
    }
    const Vec3 axis =
        move.start.axis == move.end.axis ? move.start.axis : slerp(move.start.axis, move.end.axis, t);
    if (move.arc) return {arc_point(move, ArcFrame(move), t), axis, turn};
    return {lerp(move.start.tip_mm, move.end.tip_mm, t), axis, turn};
}

Box3 tip_bounds(const Move& move) {
    Box3 box;
    box.include(move.start.tip_mm);
    box.include(move.end.tip_mm);
    if (move.quadratic) {
        const Vec3 a = move.start.tip_mm, c = move.quadratic->tip_control_mm, b = move.end.tip_mm;
        for (int k = 0; k < 3; ++k) {
            const double bend = a[k] - 2 * c[k] + b[k];
            const double t = bend != 0 ? (a[k] - c[k]) / bend : 0;
            if (t > 0 && t < 1) box.include(quadratic_point(a, c, b, t));
        }
    } else if (move.arc && move.arc->turn_rad != 0) {
        const ArcFrame frame(move);
        for (int k = 0; k < 3; ++k) include_extremes(box, move, frame, k);
    }
    return box;
}

}  // namespace tribo::motion
