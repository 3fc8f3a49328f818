// SPDX-License-Identifier: MIT
// Approximates curves of poses by quadratic pieces within a tolerance. Private to motion/.
#pragma once

#include <algorithm>
#include <array>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"
#include "motion/curve/bezier.hpp"
#include "motion/path/moves.hpp"

namespace tribo::motion {

// Share of the tolerance that a piece may use at the checked parameters. The rest is for the parameters
// between them.
inline constexpr double kCheckedShare = 0.9;
// Largest number of halvings. After it a piece is accepted as it is: a cusp, where no quadratic ever fits.
inline constexpr int kCutDepth = 24;
// A pose nearer than this to the end of the move before counts as that end, mm and rad.
inline constexpr double kJoin = 1e-9;
// Parameters where the error of a quadratic that meets a cubic at 0, 1/2 and 1 is largest (0.211, 0.789), and
// others around them.
inline constexpr std::array<double, 6> kChecked{0.1, 0.2113, 0.35, 0.65, 0.7887, 0.9};

inline bool is_same_pose(const ToolPose& a, const ToolPose& b) {
    return distance(a.tip_mm, b.tip_mm) < kJoin && distance(a.axis, b.axis) < kJoin;
}

// Returns the middle control point with which the axis goes from a to b through `middle` at constant speed,
// to the fifth order if they are on one great circle.
inline Vec3 axis_control(Vec3 a, Vec3 middle, Vec3 b) {
    const double half = 0.5 * angle_rad(a, b);
    const double size = half > 1e-4 ? math::sin(half) / half : 1 - half * half / 6;
    return (2 * size) * middle - 0.5 * (a + b);
}

// Calls sink(piece, a, b), in order, for the pieces that represent pose_of(u), u from a to b, until it
// returns false. The pieces have the words of `like`.
template <class PoseOf, class Sink>
class QuadraticCut {
  public:
    QuadraticCut(const PoseOf& pose_of, const Move& like, const PieceTolerance& tolerance, const Sink& sink)
        : pose_of_(pose_of), like_(like), tolerance_(tolerance), sink_(sink) {}

    // Returns true if all pieces were accepted.
    bool cut(double a, const ToolPose& start, double b, const ToolPose& end, int depth = 0) const {
        const double m = 0.5 * (a + b);
        const ToolPose middle = pose_of_(m);
        Move piece = like_;
        piece.start = start;
        piece.end = end;
        piece.arc.reset();
        piece.quadratic = Quadratic{2.0 * middle.tip_mm - 0.5 * (start.tip_mm + end.tip_mm),
                                    axis_control(start.axis, middle.axis, end.axis)};
        if (depth < kCutDepth && !fits(piece, a, b, middle)) {
            return cut(a, start, m, middle, depth + 1) && cut(m, middle, b, end, depth + 1);
        }
        if (is_same_pose(start, end) && distance(middle.tip_mm, start.tip_mm) <= kJoin) return true;
        return sink_(piece, a, b);
    }

  private:
    bool fits(const Move& piece, double a, double b, const ToolPose& middle) const {
        const double turn = angle_rad(piece.start.axis, middle.axis) + angle_rad(middle.axis, piece.end.axis);
        const double way =
            distance(piece.start.tip_mm, middle.tip_mm) + distance(middle.tip_mm, piece.end.tip_mm);
        if (turn > kMaxPieceTurnRad || (turn > tolerance_.axis_rad && way > kMaxTurningPieceMm)) return false;
        return std::all_of(kChecked.begin(), kChecked.end(), [&](double t) {
            const ToolPose is = pose_at(piece, t), should = pose_of_(mix(a, b, t));
            return distance(is.tip_mm, should.tip_mm) <= kCheckedShare * tolerance_.tip_mm &&
                   distance(is.axis, should.axis) <= kCheckedShare * tolerance_.axis_rad;
        });
    }

    const PoseOf& pose_of_;
    const Move& like_;
    const PieceTolerance& tolerance_;
    const Sink& sink_;
};

}  // namespace tribo::motion
