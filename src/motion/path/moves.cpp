// SPDX-License-Identifier: MIT
#include "motion/path/moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"
#include "motion/algebra/quadratic_cut.hpp"
#include "motion/curve/arc_frame.hpp"
#include "motion/path/path.hpp"

namespace tribo::motion {

namespace {

// Share of the tolerance within which a piece counts as straight. Merging neighbours adds up a few of these
// errors.
constexpr double kStraightShare = 0.01;

Move with_ends(const Move& like, const ToolPose& start, const ToolPose& end) {
    Move m = like;
    m.start = start;
    m.end = end;
    m.arc.reset();
    m.quadratic.reset();
    return m;
}

bool is_nothing(const Move& m) {
    return is_same_pose(m.start, m.end);
}

class Cutting {
  public:
    Cutting(const Move& like, const PieceTolerance& tolerance, std::size_t most, std::vector<Move>& moves)
        : like_(like), tolerance_(tolerance), most_(most), moves_(moves), first_(moves.size()) {}

    // Returns false if the moves are too many.
    bool append(const BezierMotion& motion) {
        ToolPose start = motion.pose(0);
        if (!moves_.empty()) {
            const ToolPose& before = moves_.back().end;
            if (is_same_pose(before, start)) start = before;
        }
        const ToolPose end = motion.pose(1);
        if (!is_straight(motion)) return cut(motion, start, end);
        append_straight(with_ends(like_, start, end));
        return fits();
    }

  private:
    // The curve lies in the hull of its control points. If they do not turn back, the curve does not either.
    bool is_straight(const BezierMotion& motion) const {
        const double tip_tolerance = kStraightShare * tolerance_.tip_mm;
        const double axis_tolerance = kStraightShare * tolerance_.axis_rad;
        const std::vector<HomogeneousPoint> tips = point_path(motion, Vec3{0, 0, 0});
        const std::vector<HomogeneousPoint> axes = direction_path(motion, Vec3{0, 0, 1});
        const Vec3 first = motion.pose(0).tip_mm, axis = motion.pose(0).axis;
        const Vec3 along = normalized(motion.pose(1).tip_mm - first);
        double reached = 0;
        for (const HomogeneousPoint& tip : tips) {
            if (!(tip.w > 0)) return false;
            const Vec3 from_first = tip.point() - first;
            const double run = dot(from_first, along);
            if (length(from_first - run * along) > tip_tolerance || run < reached - tip_tolerance)
                return false;
            reached = std::max(reached, run);
        }
        return std::all_of(axes.begin(), axes.end(), [&](const HomogeneousPoint& a) {
            return distance(a.point(), axis) <= axis_tolerance;
        });
    }

    void append_straight(const Move& next) {
        if (is_nothing(next)) return;
        if (moves_.size() > first_ && !moves_.back().quadratic) {
            Move& last = moves_.back();
            const Vec3 whole = next.end.tip_mm - last.start.tip_mm;
            const Vec3 along = normalized(whole), so_far = last.end.tip_mm - last.start.tip_mm;
            const double run = dot(so_far, along);
            if (run > 0 && run < length(whole) &&
                length(so_far - run * along) <= kStraightShare * tolerance_.tip_mm) {
                last.end = next.end;
                return;
            }
        }
        moves_.push_back(next);
    }

    bool cut(const BezierMotion& motion, const ToolPose& start, const ToolPose& end) {
        const auto pose_of = [&](double u) { return motion.pose(u); };
        const auto sink = [&](const Move& piece, double, double) {
            moves_.push_back(piece);
            return fits();
        };
        return QuadraticCut(pose_of, like_, tolerance_, sink).cut(0, start, 1, end);
    }

    bool fits() const { return moves_.size() - first_ <= most_; }

    const Move& like_;
    const PieceTolerance& tolerance_;
    std::size_t most_;
    std::vector<Move>& moves_;
    std::size_t first_;
};

// Returns the part of a Bezier motion from a to b, 0 <= a < b <= 1.
BezierMotion part_of(const BezierMotion& motion, double a, double b) {
    BezierMotion part = motion;
    if (b < 1) part = subdivide(part, b).first;
    if (a > 0) part = subdivide(part, a / b).second;
    return part;
}

int quarters_of(const Arc& arc) {
    // An excess over a multiple of a quarter turn that is only rounding does not start a new piece.
    const double quarters = std::abs(arc.turn_rad) / math::kHalfPi;
    return std::max(1, static_cast<int>(std::ceil(quarters - 1e-9)));
}

std::vector<Move> quarter_arcs(const Move& move) {
    const int count = quarters_of(*move.arc);
    std::vector<Move> pieces;
    for (int i = 0; i < count; ++i) {
        Move piece = move;
        piece.start = i == 0 ? move.start : pieces.back().end;
        piece.end = pose_at(move, static_cast<double>(i + 1) / count);
        piece.arc->turn_rad = move.arc->turn_rad / count;
        piece.duration_s = move.duration_s / count;
        pieces.push_back(piece);
    }
    return pieces;
}

// Returns the number of quadratics of equal parameter that represent the move. With a = half the turn of a
// piece: control points where the tangents of an arc meet deviate from it by R a^4 / 8 and run ahead of it by
// up to 0.065 a^3 rad; a rise turns the latter into height. Control points that match the middle deviate from
// a circle by 0.065 R a^3. An axis on a great circle deviates by 0.0041 a^5 rad.
int quadratics_needed(const Move& move, const PieceTolerance& tolerance, double axis_turn) {
    double count = axis_turn / kMaxPieceTurnRad;
    const auto need = [&](double n) { count = std::max(count, n); };
    if (axis_turn > 0) need(path_length_mm(move) / kMaxTurningPieceMm);
    need(0.5 * axis_turn * math::pow(0.0041 / tolerance.axis_rad, 0.2));
    if (move.arc && move.arc->turn_rad != 0) {
        const ArcFrame frame(move);
        const double turn = std::abs(move.arc->turn_rad), half_tolerance = 0.5 * tolerance.tip_mm;
        need(turn / (0.5 * math::kHalfPi));
        if (axis_turn > 0)
            need(0.5 * turn *
                 math::cbrt(0.065 * (frame.radius_mm + std::abs(frame.rise_mm)) / half_tolerance));
        else {
            need(0.5 * turn * std::sqrt(std::sqrt(frame.radius_mm / (8 * half_tolerance))));
            need(0.5 * turn * math::cbrt(0.065 * std::abs(frame.rise_mm) / turn / half_tolerance));
        }
    }
    return std::max(1, static_cast<int>(std::ceil(count)));
}

std::vector<Move> equal_quadratics(const Move& move, const PieceTolerance& tolerance) {
    const double axis_turn = angle_rad(move.start.axis, move.end.axis);
    const int count = quadratics_needed(move, tolerance, axis_turn);
    std::vector<Move> pieces;
    for (int i = 0; i < count; ++i) {
        const double a = static_cast<double>(i) / count, b = static_cast<double>(i + 1) / count;
        Move piece = with_ends(move, i == 0 ? move.start : pieces.back().end, pose_at(move, b));
        const ToolPose middle = pose_at(move, 0.5 * (a + b));
        Vec3 control = 2.0 * middle.tip_mm - 0.5 * (piece.start.tip_mm + piece.end.tip_mm);
        if (move.arc && axis_turn == 0) {
            // The point where the tangents meet: radius R / cos(a) above the middle.
            const ArcFrame frame(move);
            const Vec3 from_start = middle.tip_mm - frame.foot_mm;
            const Vec3 radial = from_start - dot(from_start, frame.normal) * frame.normal;
            control = middle.tip_mm + (1 / math::cos(0.5 * move.arc->turn_rad / count) - 1) * radial;
        }
        piece.quadratic = Quadratic{control, axis_control(piece.start.axis, middle.axis, piece.end.axis)};
        piece.duration_s = move.duration_s / count;
        pieces.push_back(piece);
    }
    return pieces;
}

// The elementary moves that a move becomes.
enum class Pieces { whole, arcs, quadratics };

Pieces pieces_of(const Move& move, const PieceTolerance& tolerance) {
    if (move.kind == MoveKind::dwell || move.quadratic) return Pieces::whole;
    const bool turns = angle_rad(move.start.axis, move.end.axis) > kStraightShare * tolerance.axis_rad;
    if (!move.arc) return turns ? Pieces::quadratics : Pieces::whole;
    const ArcFrame frame(move);
    const bool upright = length(cross(frame.normal, move.start.axis)) <= kStraightShare * tolerance.axis_rad;
    const bool flat = std::abs(frame.rise_mm) <= kStraightShare * tolerance.tip_mm;
    return !turns && upright && flat ? Pieces::arcs : Pieces::quadratics;
}

}  // namespace

bool append_moves(const BSplineMotion& motion, double u0, double u1, const Move& like,
                  const PieceTolerance& tolerance, std::size_t most, std::vector<Move>& moves) {
    const BSpline<DualQuaternion>& spline = motion.spline;
    Cutting cutting(like, tolerance, most, moves);
    for (std::size_t k = find_span(spline, u0); k < spline.control.size() && spline.knots[k] < u1; ++k) {
        if (spline.knots[k] == spline.knots[k + 1]) continue;
        const MotionPiece piece = bezier_piece(motion, k);
        const double a = std::max(u0, piece.start), b = std::min(u1, piece.end);
        const double width = piece.end - piece.start;
        const BezierMotion part = part_of(piece.motion, a == piece.start ? 0 : (a - piece.start) / width,
                                          b == piece.end ? 1 : (b - piece.start) / width);
        if (!cutting.append(part)) return false;
    }
    return true;
}

std::vector<Move> to_elementary(const Move& move, const PieceTolerance& tolerance) {
    switch (pieces_of(move, tolerance)) {
        case Pieces::arcs:
            return quarter_arcs(move);
        case Pieces::quadratics:
            return equal_quadratics(move, tolerance);
        case Pieces::whole:
            break;
    }
    return {move};
}

std::size_t count_elementary(const Move& move, const PieceTolerance& tolerance) {
    switch (pieces_of(move, tolerance)) {
        case Pieces::arcs:
            return static_cast<std::size_t>(quarters_of(*move.arc));
        case Pieces::quadratics:
            return static_cast<std::size_t>(
                quadratics_needed(move, tolerance, angle_rad(move.start.axis, move.end.axis)));
        case Pieces::whole:
            break;
    }
    return 1;
}

}  // namespace tribo::motion
