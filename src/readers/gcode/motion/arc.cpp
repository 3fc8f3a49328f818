// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/arc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::gcode {
namespace {

// Ends closer than this in the plane count as one point, mm: below the last digit of any program, above the
// rounding error of summed increments.
constexpr double kSamePointMm = 1e-6;
// Half a chord may exceed the radius by this much, mm: the rounding of coordinates with three decimals.
constexpr double kRadiusToleranceMm = 0.005;

struct RadiusTolerance {
    double always_mm, largest_mm, coarse_mm;
};
constexpr double kRelativeTolerance = 0.001;
// Chords stay this close to their arc, mm.
constexpr double kChordMm = 1e-3;
constexpr double kMostChords = 100'000;

RadiusTolerance tolerance_for(double unit_mm) {
    // Ends and centre rounded or cut to 0.01 mm or 0.001 inch.
    if (unit_mm == 1) return {0.005, 0.5, 2 * 0.01 * std::numbers::sqrt2};
    return {0.0005 * unit_mm, 0.05 * unit_mm, 2 * 0.001 * std::numbers::sqrt2 * unit_mm};
}

struct InPlane {
    double u = 0, v = 0;
};

InPlane difference(const ArcEnds& ends, Vec3 to, Vec3 from) {
    const auto axes = axes_of(ends.plane);
    return {to[axes[0]] - from[axes[0]], to[axes[1]] - from[axes[1]]};
}

motion::Arc make_arc(const ArcEnds& ends, Vec3 centre, double turn_rad) {
    motion::Arc arc;
    arc.centre_mm = centre;
    arc.normal = {0, 0, 0};
    arc.normal[axes_of(ends.plane)[2]] = ends.clockwise ? -1 : 1;
    arc.turn_rad = turn_rad + math::kTwoPi * ends.extra_turns;
    return arc;
}

}  // namespace

Result<motion::Arc> arc_about_centre(const ArcEnds& ends, Vec3 centre_mm, double unit_mm) {
    const auto axes = axes_of(ends.plane);
    centre_mm[axes[2]] = ends.start_mm[axes[2]];
    const InPlane from = difference(ends, ends.start_mm, centre_mm);
    const InPlane to = difference(ends, ends.end_mm, centre_mm);
    const double start_radius = math::hypot(from.u, from.v), end_radius = math::hypot(to.u, to.v);
    if (start_radius <= kSamePointMm) {
        return fail("the arc has its centre at its start, so no radius", "correct I, J and K");
    }
    const double off = std::abs(start_radius - end_radius);
    const RadiusTolerance tolerance = tolerance_for(unit_mm);
    const bool is_off =
        off > tolerance.largest_mm ||
        (off > tolerance.always_mm && off > kRelativeTolerance * std::max(start_radius, end_radius));
    if (is_off && !(ends.is_coarse && off <= tolerance.coarse_mm)) {
        return fail(
            "the arc's radius is " + mm_text(start_radius) + " at its start and " + mm_text(end_radius) +
                " at its end",
            "correct the end or the centre; say so where centres are absolute (G90.1, on Siemens I=AC(..))");
    }

    const InPlane chord = difference(ends, ends.end_mm, ends.start_mm);
    if (math::hypot(chord.u, chord.v) <= kSamePointMm) return make_arc(ends, centre_mm, math::kTwoPi);
    const double turned_left = from.u * to.v - from.v * to.u;
    double turn = math::atan2(ends.clockwise ? -turned_left : turned_left, from.u * to.u + from.v * to.v);
    if (turn <= 0) turn += math::kTwoPi;
    return make_arc(ends, centre_mm, turn);
}

Result<motion::Arc> arc_of_radius(const ArcEnds& ends, double radius_mm) {
    const auto axes = axes_of(ends.plane);
    const InPlane chord = difference(ends, ends.end_mm, ends.start_mm);
    const double length = math::hypot(chord.u, chord.v), half = 0.5 * length;
    if (length <= kSamePointMm) {
        return fail("an arc given by R ends where it starts, so it has no direction",
                    "give the centre of a full circle with I, J and K");
    }
    const double radius = std::abs(radius_mm);
    if (half > radius + kRadiusToleranceMm) {
        return fail("radius " + mm_text(radius) + " cannot reach the end, which lies " + mm_text(length) +
                        " from the start",
                    "correct R or the end; R is a radius, not a diameter");
    }
    // Distance of the midpoint of the chord from the centre.
    const double apothem = half < radius ? std::sqrt((radius - half) * (radius + half)) : 0;
    const bool centre_on_left = ends.clockwise == (radius_mm < 0);
    const double side = (centre_on_left ? apothem : -apothem) / length;
    Vec3 centre = 0.5 * (ends.start_mm + ends.end_mm);
    centre[axes[0]] -= side * chord.v;
    centre[axes[1]] += side * chord.u;
    centre[axes[2]] = ends.start_mm[axes[2]];
    const double minor = 2 * math::atan2(half, apothem);
    return make_arc(ends, centre, radius_mm < 0 ? math::kTwoPi - minor : minor);
}

double chord_count(const motion::Arc& arc, Vec3 start_mm) {
    const double radius = distance(arc.centre_mm, start_mm);
    const double step_rad = radius > kChordMm ? 2 * std::sqrt(2 * kChordMm / radius) : math::kPi;
    return std::clamp(std::ceil(arc.turn_rad / step_rad), 1.0, kMostChords);
}

}  // namespace tribo::readers::gcode
