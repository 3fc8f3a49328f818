// SPDX-License-Identifier: MIT
#include "motion/path/path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"
#include "motion/curve/arc_frame.hpp"

namespace tribo::motion {

namespace {

// d/dt of the quadratic Bezier p0, c, p1 is u + t v.
struct LinearHodograph {
    Vec3 u, v;

    explicit LinearHodograph(const Move& m)
        : u(2.0 * (m.quadratic->tip_control_mm - m.start.tip_mm)),
          v(2.0 * (m.start.tip_mm - 2.0 * m.quadratic->tip_control_mm + m.end.tip_mm)) {}
    Vec3 at(double t) const { return u + t * v; }
};

// Integral of |u + t v| over 0..t by Gauss-Legendre, 8 nodes. For |v| <= |u| / 4 the nearest singularity of
// the integrand is at |t| >= 4, so that the error is below 1e-15 of the result.
double length_by_quadrature(const LinearHodograph& h, double t) {
    static constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                                0.9602898564975363};
    static constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                                  0.1012285362903763};
    double sum = 0;
    for (std::size_t i = 0; i < node.size(); ++i)
        sum += weight[i] * (length(h.at(0.5 * t * (1 - node[i]))) + length(h.at(0.5 * t * (1 + node[i]))));
    return 0.5 * t * sum;
}

// Integral of sqrt(s^2 + k) ds from s0 to s1, k >= 0.
double length_of_parabola(double s0, double s1, double k) {
    const double r0 = std::sqrt(s0 * s0 + k), r1 = std::sqrt(s1 * s1 + k);
    double area = 0.5 * (s1 * r1 - s0 * r0);
    if (k > 0) {
        // s + sqrt(s^2 + k) without cancellation for negative s.
        const double g0 = s0 < 0 ? k / (r0 - s0) : r0 + s0;
        const double g1 = s1 < 0 ? k / (r1 - s1) : r1 + s1;
        if (g0 > 0 && g1 > 0) area += 0.5 * k * math::log(g1 / g0);
    }
    return area;
}

double quadratic_length(const Move& move, double t) {
    const LinearHodograph h(move);
    const double vv = squared_length(h.v), uu = squared_length(h.u);
    if (16 * vv <= uu) return length_by_quadrature(h, t);
    const double s0 = dot(h.u, h.v) / vv;
    const double k = squared_length(cross(h.u, h.v)) / (vv * vv);
    return std::sqrt(vv) * length_of_parabola(s0, s0 + t, k);
}

}  // namespace

Vec3 tip_derivative_mm(const Move& move, double t) {
    if (move.kind == MoveKind::dwell) return {0, 0, 0};
    if (move.quadratic) return LinearHodograph(move).at(t);
    if (move.arc) {
        const ArcFrame a(move);
        const double turn = move.arc->turn_rad;
        return turn * turned(a.sideways, a.normal, t * turn) + a.rise_mm * a.normal;
    }
    return move.end.tip_mm - move.start.tip_mm;
}

double path_length_mm(const Move& move, double t) {
    if (move.kind == MoveKind::dwell) return 0;
    if (move.quadratic) return quadratic_length(move, t);
    if (move.arc) {
        const ArcFrame a(move);
        return t * math::hypot(a.radius_mm * move.arc->turn_rad, a.rise_mm);
    }
    return t * distance(move.start.tip_mm, move.end.tip_mm);
}

double path_length_mm(const Move& move) {
    return path_length_mm(move, 1);
}

double parameter_at_length(const Move& move, double length_mm) {
    const double whole = path_length_mm(move, 1);
    if (!(whole > 0) || !(length_mm > 0)) return 0;
    if (length_mm >= whole) return 1;
    if (!move.quadratic) return length_mm / whole;
    // Newton's method inside a bracket that is halved where the speed vanishes (a cusp).
    double low = 0, high = 1, t = length_mm / whole;
    for (int i = 0; i < 100; ++i) {
        const double off = quadratic_length(move, t) - length_mm;
        if (std::abs(off) <= 1e-13 * whole) break;
        (off > 0 ? high : low) = t;
        const double speed = length(LinearHodograph(move).at(t));
        const double next = t - off / speed;
        t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return t;
}

double max_curvature_per_mm(const Move& move) {
    if (move.kind == MoveKind::dwell) return 0;
    if (move.arc) {
        // Helix of radius r and rise b per radian: r / (r^2 + b^2).
        const ArcFrame a(move);
        const double r = a.radius_mm, turn = move.arc->turn_rad;
        const double b = turn != 0 ? a.rise_mm / turn : 0;
        return r > 0 ? r / (r * r + b * b) : 0;
    }
    if (!move.quadratic) return 0;
    // |u x v| is constant, so curvature |u x v| / |u + t v|^3 is largest where the speed is smallest.
    const LinearHodograph h(move);
    const double vv = squared_length(h.v);
    if (vv == 0) return 0;
    const double t = std::clamp(-dot(h.u, h.v) / vv, 0.0, 1.0);
    const double speed = length(h.at(t));
    const double bend = length(cross(h.u, h.v));
    // A straight path that turns back on itself: the bend is rounding, and the speed passes through zero.
    if (speed <= 1e-9 * (length(h.u) + length(h.v))) return std::numeric_limits<double>::infinity();
    return bend / (speed * speed * speed);
}

double axis_turn_rad(const Move& move) {
    if (move.kind == MoveKind::dwell) return 0;
    if (!move.quadratic) return angle_rad(move.start.axis, move.end.axis);
    const Vec3 middle = pose_at(move, 0.5).axis;
    return angle_rad(move.start.axis, middle) + angle_rad(middle, move.end.axis);
}

Move first_part(const Move& move, double t) {
    if (t >= 1) return move;
    Move part = move;
    part.end = pose_at(move, t);
    const double length = path_length_mm(move);
    part.duration_s *= length > 0 ? path_length_mm(move, t) / length : t;
    if (part.arc) part.arc->turn_rad *= t;
    if (part.quadratic) {
        part.quadratic->tip_control_mm = lerp(move.start.tip_mm, move.quadratic->tip_control_mm, t);
        part.quadratic->axis_control = lerp(move.start.axis, move.quadratic->axis_control, t);
        // The end of the axis curve is normalised. Its middle point is divided by the root of its length, so
        // that the axis stays on the same cone.
        const Vec3 end =
            lerp(part.quadratic->axis_control, lerp(move.quadratic->axis_control, move.end.axis, t), t);
        part.quadratic->axis_control = part.quadratic->axis_control / std::sqrt(tribo::length(end));
    }
    return part;
}

Move last_part(const Move& move, double t) {
    if (t <= 0) return move;
    const auto reversed = [](Move m) {
        std::swap(m.start, m.end);
        if (m.arc) m.arc->normal = -1.0 * m.arc->normal;
        return m;
    };
    return reversed(first_part(reversed(move), 1 - t));
}

std::vector<Move> in_pieces(const Move& move, double longest_mm) {
    const double length = path_length_mm(move);
    std::vector<Move> pieces;
    Move rest = move;
    for (int left = std::max(1, static_cast<int>(std::ceil(length / longest_mm))); left > 1; --left) {
        const double t = parameter_at_length(rest, path_length_mm(rest) / left);
        if (!(t > 0 && t < 1)) break;
        pieces.push_back(first_part(rest, t));
        rest = last_part(rest, t);
        rest.start = pieces.back().end;
    }
    pieces.push_back(rest);
    return pieces;
}

}  // namespace tribo::motion
