// SPDX-License-Identifier: MIT
// Poles and circles: by centre, radius or opening angle, through a point, tangent to the last move.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"

namespace tribo::readers::siemens {
namespace {

// Shorter is no distance between points of a circle, mm.
constexpr double kSamePointMm = 1e-6;
constexpr double kMostTurns = 10'000;

}  // namespace

// G110: about the last position; G111: about the zero; G112: about the last pole.
Result<void> Interpreter::set_pole(const Words& words, int code) {
    Vec3 pole = code == 110 ? here() : code == 112 ? pole_.value_or(Vec3{}) : Vec3{};
    const auto [u, v, w] = axes();
    for (const int k : {u, v}) {
        const auto& word = words.linear[static_cast<std::size_t>(k)];
        if (!word) continue;
        const double mm = word->value * unit_mm_;
        if (auto good = path_.in_range(kLimits.coordinate, mm, place(word->column)); !good) return good;
        pole[k] += scale_[k] * mm;
    }
    if (words.has_polar()) {
        const double radius = words.polar_radius ? words.polar_radius->value * unit_mm_ : 0;
        const double angle = words.polar_angle ? words.polar_angle->value * math::kRadPerDeg : 0;
        if (auto good = path_.in_range(kLimits.coordinate, radius, place(words.first_column)); !good)
            return good;
        pole[u] += scale_[u] * radius * math::cos(angle);
        pole[v] += scale_[v] * radius * math::sin(angle);
    }
    pole_ = pole;
    return {};
}

Result<motion::Arc> Interpreter::circle(const Words& words, Vec3& to) {
    const auto [u, v, w] = axes();
    const bool in_space = motion_ == Motion::through_point;
    const bool is_even = std::abs(scale_[u]) == std::abs(scale_[v]) &&
                         (!in_space || std::abs(scale_[u]) == std::abs(scale_[w]));
    if (!is_even) {
        return path_.refuse(place(words.first_column), "a circle in a frame with different scales is none",
                            "write the same factor for all axes");
    }
    if (in_space) return circle_through(words, to);
    if (motion_ == Motion::tangent) return tangent_circle(words, to);
    const bool is_mirrored = scale_[u] * scale_[v] < 0;
    auto arc = circle_about(words, to, (motion_ == Motion::clockwise) != is_mirrored);
    if (!arc) return arc;
    if (words.turns) {
        if (!(*words.turns >= 0 && *words.turns <= kMostTurns)) {
            return path_.refuse(place(words.first_column), "TURN is out of range", "write 0 to 10000");
        }
        arc->turn_rad += math::kTwoPi * std::floor(*words.turns);
    }
    return arc;
}

// G2 and G3 with CR, AR, RP and AP, or I J K.
Result<motion::Arc> Interpreter::circle_about(const Words& words, Vec3& to, bool clockwise) {
    const auto [u, v, w] = axes();
    const Place where = place(words.first_column);
    gcode::ArcEnds ends;
    ends.plane = plane_;
    ends.clockwise = clockwise;
    ends.start_mm = here();
    ends.end_mm = to;
    const auto checked = [&](Result<motion::Arc> arc) -> Result<motion::Arc> {
        if (arc) return arc;
        return path_.refuse(where, arc.error().cause,
                            arc.error().remedy.empty() ? "correct the circle" : arc.error().remedy);
    };
    const double scale = std::abs(scale_[u]);
    if (words.radius) {
        const double radius = *words.radius * unit_mm_ * scale;
        if (auto good = path_.in_range(kLimits.coordinate, radius, where); !good)
            return std::unexpected(good.error());
        const bool is_closed =
            std::abs(to[u] - here()[u]) < kSamePointMm && std::abs(to[v] - here()[v]) < kSamePointMm;
        if (is_closed) {
            return path_.refuse(where, "a full circle by its radius: its centre is not known",
                                "write I and J");
        }
        return checked(gcode::arc_of_radius(ends, radius));
    }
    const auto sweep = [&]() -> Result<double> {
        const double rad = *words.opening * math::kRadPerDeg;
        if (rad > 0 && *words.opening <= 360) return rad;
        return path_.refuse(where, "AR is not an angle of 0 to 360 degrees", "correct it");
    };
    if (words.has_centre()) {
        Vec3 centre = here();
        for (int k = 0; k < 3; ++k) {
            const auto& word = words.centre[static_cast<std::size_t>(k)];
            if (!word) continue;
            const double mm = word->value * unit_mm_;
            if (auto good = path_.in_range(kLimits.coordinate, mm, place(word->column)); !good)
                return std::unexpected(good.error());
            centre[k] = scale_[k] * mm + (word->measure == Measure::absolute ? 0 : here()[k]);
        }
        if (words.opening) {  // the end follows
            const auto turn = sweep();
            if (!turn) return std::unexpected(turn.error());
            const double du = here()[u] - centre[u], dv = here()[v] - centre[v];
            const double rad = clockwise ? -*turn : *turn;
            ends.end_mm[u] = to[u] = centre[u] + du * math::cos(rad) - dv * math::sin(rad);
            ends.end_mm[v] = to[v] = centre[v] + du * math::sin(rad) + dv * math::cos(rad);
        }
        return checked(gcode::arc_about_centre(ends, centre, unit_mm_));
    }
    if (words.opening) {  // by the end
        const auto turn = sweep();
        if (!turn) return std::unexpected(turn.error());
        const double chord = math::hypot(to[u] - here()[u], to[v] - here()[v]);
        const double radius = chord / (2 * math::sin(*turn / 2));
        if (!(chord > kSamePointMm) || !kLimits.coordinate.range.contains(radius)) {
            return path_.refuse(where, "AR with this end gives no circle", "write I and J");
        }
        return checked(gcode::arc_of_radius(ends, *turn > math::kPi ? -radius : radius));
    }
    if (words.has_polar()) return checked(gcode::arc_about_centre(ends, pole_.value_or(Vec3{}), unit_mm_));
    return path_.refuse(where, "a circle without centre, radius or opening angle", "write I J, CR= or AR=");
}

// CIP: the circle through I1 J1 K1, in any plane.
Result<motion::Arc> Interpreter::circle_through(const Words& words, Vec3 to) {
    const Place where = place(words.first_column);
    const Vec3 from = here();
    Vec3 middle = from;
    for (int k = 0; k < 3; ++k) {
        const auto& word = words.through[static_cast<std::size_t>(k)];
        if (!word) continue;
        const double mm = word->value * unit_mm_;
        if (auto good = path_.in_range(kLimits.coordinate, mm, place(word->column)); !good)
            return std::unexpected(good.error());
        const bool adds =
            word->measure == Measure::incremental || (word->measure == Measure::modal && incremental_);
        middle[k] = scale_[k] * mm + (adds ? from[k] : 0);
    }
    const Vec3 a = middle - from, b = to - from, normal = cross(a, b);
    const double square = squared_length(normal);
    if (!(square > 1e-18 * squared_length(a) * squared_length(b))) {
        return path_.refuse(where, "the three points of CIP lie on a line, or two of them are one",
                            "correct I1 J1 K1, or write G1");
    }
    const Vec3 centre =
        from + (squared_length(a) * cross(b, normal) + squared_length(b) * cross(normal, a)) / (2 * square);
    if (!(distance(centre, from) < kLimits.coordinate.range.max)) {
        return path_.refuse(where, "the radius of CIP is more than a kilometre", "write G1");
    }
    motion::Arc arc;
    arc.centre_mm = centre;
    arc.normal = normalized(normal);
    const Vec3 start = from - centre, end = to - centre;
    arc.turn_rad = math::atan2(dot(arc.normal, cross(start, end)), dot(start, end));
    if (arc.turn_rad <= 0) arc.turn_rad += math::kTwoPi;
    return arc;
}

// CT: tangent to the last move, in the plane.
Result<motion::Arc> Interpreter::tangent_circle(const Words& words, Vec3 to) {
    const Place where = place(words.first_column);
    const auto [u, v, w] = axes();
    const double length = math::hypot(tangent_[u], tangent_[v]);
    if (!(length > 1e-9)) {
        return path_.refuse(where, "CT with nothing before it to be tangent to", "write G1 or G2 before it");
    }
    const double tu = tangent_[u] / length, tv = tangent_[v] / length;
    const double du = to[u] - here()[u], dv = to[v] - here()[v];
    const double across = -du * tv + dv * tu, chord = math::hypot(du, dv);
    if (std::abs(across) <= 1e-9 * chord) {
        return path_.refuse(where, "the end of CT lies straight ahead: no arc leads there", "write G1");
    }
    const double radius = chord * chord / (2 * across);
    if (!kLimits.coordinate.range.contains(radius)) {
        return path_.refuse(where, "the radius of CT is more than a kilometre", "write G1");
    }
    gcode::ArcEnds ends;
    ends.plane = plane_;
    ends.clockwise = radius < 0;
    ends.start_mm = here();
    ends.end_mm = to;
    Vec3 centre = here();
    centre[u] -= radius * tv;
    centre[v] += radius * tu;
    auto arc = gcode::arc_about_centre(ends, centre, unit_mm_);
    if (!arc) return path_.refuse(where, arc.error().cause, "correct the end");
    return arc;
}

}  // namespace tribo::readers::siemens
