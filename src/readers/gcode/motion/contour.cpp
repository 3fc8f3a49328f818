// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/contour.hpp"

#include <cmath>

#include "base/math.hpp"

namespace tribo::readers::gcode {
namespace {

// Points closer than this count as one, mm.
constexpr double kSameCornerMm = 1e-7;

Point operator+(Point a, Point b) {
    return {a.u + b.u, a.v + b.v};
}
Point operator-(Point a, Point b) {
    return {a.u - b.u, a.v - b.v};
}
Point operator*(double s, Point a) {
    return {s * a.u, s * a.v};
}
double dot(Point a, Point b) {
    return a.u * b.u + a.v * b.v;
}
double cross(Point a, Point b) {
    return a.u * b.v - a.v * b.u;
}
Point left_of(Point a) {
    return {-a.v, a.u};
}
Point unit(Point a) {
    const double size = math::hypot(a.u, a.v);
    return size > 0 ? (1 / size) * a : Point{1, 0};
}

// Returns a turn from 0 to a full turn, in the direction of `sign`. Nearly a full turn counts as 0.
double turn_from(Point centre, Point a, Point b, double sign) {
    double turn = sign * turn_between(a - centre, b - centre);
    const double least = -kSameCornerMm / std::max(distance(a, centre), kSameCornerMm);
    if (turn < least) turn += math::kTwoPi;
    return std::max(turn, 0.0);
}

Crossings line_line(const Element& a, const Element& b) {
    Crossings found;
    const Point d = a.start_direction(), e = b.start_direction();
    const double sine = cross(d, e);
    if (std::abs(sine) > 1e-12) found.add(a.start + (cross(b.start - a.start, e) / sine) * d);
    return found;
}

Crossings line_circle(const Element& line, Point centre, double radius) {
    Crossings found;
    const Point d = line.start_direction();
    const Point foot = line.start + dot(centre - line.start, d) * d;
    const double height = distance(foot, centre);
    if (height > radius + kSameCornerMm) return found;
    const double half = height < radius ? std::sqrt((radius - height) * (radius + height)) : 0;
    found.add(foot + half * d);
    found.add(foot - half * d);
    return found;
}

Crossings circle_circle(Point a, double radius_a, Point b, double radius_b) {
    Crossings found;
    const double apart = distance(a, b);
    if (apart < kSameCornerMm) return found;
    const double along = (apart * apart + radius_a * radius_a - radius_b * radius_b) / (2 * apart);
    const double square = radius_a * radius_a - along * along;
    if (square < -2 * radius_a * kSameCornerMm) return found;
    const double aside = square > 0 ? std::sqrt(square) : 0;
    const Point d = unit(b - a);
    found.add(a + along * d + aside * left_of(d));
    found.add(a + along * d - aside * left_of(d));
    return found;
}

double radius_of(const Element& arc) {
    return distance(arc.centre, arc.end);
}

Crossings of_curves(const Element& a, const Element& b) {
    if (!a.is_arc() && !b.is_arc()) return line_line(a, b);
    if (!a.is_arc()) return line_circle(a, b.centre, radius_of(b));
    if (!b.is_arc()) return line_circle(b, a.centre, radius_of(a));
    return circle_circle(a.centre, radius_of(a), b.centre, radius_of(b));
}

}  // namespace

double distance(Point a, Point b) {
    return math::hypot(a.u - b.u, a.v - b.v);
}

double turn_between(Point a, Point b) {
    return math::atan2(cross(a, b), dot(a, b));
}

double Element::length() const {
    return is_arc() ? std::abs(turn_rad) * radius_of(*this) : distance(start, end);
}

double Element::curvature_per_mm() const {
    if (!is_arc()) return 0;
    return (turn_rad > 0 ? 1 : -1) / std::max(radius_of(*this), kSameCornerMm);
}

Point Element::start_direction() const {
    if (!is_arc()) return unit(end - start);
    const Point d = left_of(unit(start - centre));
    return turn_rad > 0 ? d : -1 * d;
}

Point Element::end_direction() const {
    if (!is_arc()) return unit(end - start);
    const Point d = left_of(unit(end - centre));
    return turn_rad > 0 ? d : -1 * d;
}

double Element::before_end(Point p) const {
    if (!is_arc()) return dot(end - p, start_direction());
    return radius_of(*this) * turn_from(centre, p, end, turn_rad > 0 ? 1 : -1);
}

double Element::after_start(Point p) const {
    if (!is_arc()) return dot(p - start, start_direction());
    return radius_of(*this) * turn_from(centre, start, p, turn_rad > 0 ? 1 : -1);
}

void Element::set_end(Point p) {
    if (is_arc()) {
        const double sign = turn_rad > 0 ? 1 : -1;
        turn_rad -= sign * turn_from(centre, p, end, sign);
    }
    end = p;
}

void Element::set_start(Point p) {
    if (is_arc()) {
        const double sign = turn_rad > 0 ? 1 : -1;
        turn_rad -= sign * turn_from(centre, start, p, sign);
    }
    start = p;
}

std::optional<Element> offset(const Element& element, double left_mm) {
    Element moved = element;
    if (!element.is_arc()) {
        const Point aside = left_mm * left_of(element.start_direction());
        moved.start = element.start + aside;
        moved.end = element.end + aside;
        return moved;
    }
    const double outwards = element.turn_rad > 0 ? -left_mm : left_mm;
    for (Point* p : {&moved.start, &moved.end}) {
        const double radius = distance(*p, element.centre);
        if (!(radius + outwards > kSameCornerMm)) return std::nullopt;
        *p = element.centre + ((radius + outwards) / radius) * (*p - element.centre);
    }
    return moved;
}

Crossings crossings(const Element& a, const Element& b) {
    Crossings common;
    const Crossings found = of_curves(a, b);
    const auto is_on = [](const Element& element, Point p) {
        const double along = element.after_start(p);
        return along >= -kSameCornerMm && along <= element.length() + kSameCornerMm;
    };
    for (int i = 0; i < found.count; ++i) {
        const Point p = found.points[static_cast<std::size_t>(i)];
        if (is_on(a, p) && is_on(b, p)) common.add(p);
    }
    return common;
}

std::optional<Point> meeting(const Element& first, const Element& second) {
    std::optional<Point> best;
    double least = 0;
    const Crossings found = of_curves(first, second);
    for (int i = 0; i < found.count; ++i) {
        const Point p = found.points[static_cast<std::size_t>(i)];
        const double off_first = first.before_end(p), off_second = second.after_start(p);
        if (off_first < -kSameCornerMm || off_first > first.length() + kSameCornerMm) continue;
        if (off_second < -kSameCornerMm || off_second > second.length() + kSameCornerMm) continue;
        if (!best || off_first + off_second < least) {
            best = p;
            least = off_first + off_second;
        }
    }
    return best;
}

std::optional<Element> arc_into(Point start, const Element& arc) {
    // The centre is on the normal at the end, at equal distances from start and end.
    const Point normal = left_of(arc.end_direction());
    const Point back = start - arc.end;
    const double aside = dot(back, normal);
    if (std::abs(aside) <= kSameCornerMm) return std::nullopt;
    const double radius = dot(back, back) / (2 * aside);
    Element into;
    into.start = start;
    into.end = arc.end;
    into.centre = arc.end + radius * normal;
    const double sign = radius > 0 ? 1 : -1;
    into.turn_rad = sign * turn_from(into.centre, start, arc.end, sign);
    return into;
}

Element arc_about(Point centre, Point from, Point to, int side) {
    double turn = turn_between(from - centre, to - centre);
    if (side * turn < 0) turn += side * math::kTwoPi;
    return {from, to, centre, turn};
}

std::optional<Element> rounded(Element& before, Element& next, double radius_mm) {
    const int side = turn_between(before.end_direction(), next.start_direction()) > 0 ? 1 : -1;
    const auto inner = offset(before, side * radius_mm), outer = offset(next, side * radius_mm);
    const auto centre = inner && outer ? meeting(*inner, *outer) : std::nullopt;
    if (!centre) return std::nullopt;
    // The point of an element below the centre.
    const auto foot_on = [&](const Element& element) {
        if (!element.is_arc()) return *centre - side * radius_mm * left_of(element.start_direction());
        return element.centre + distance(element.centre, element.end) * unit(*centre - element.centre);
    };
    const Point leave = foot_on(before), enter = foot_on(next);
    before.set_end(leave);
    next.set_start(enter);
    return arc_about(*centre, leave, enter, side);
}

std::optional<Element> chamfered(Element& before, Element& next, double leg_mm) {
    const double shorter = std::min(before.length(), next.length());
    if (before.is_arc() || next.is_arc() || leg_mm > shorter + kSameCornerMm) return std::nullopt;
    const Point leave = before.end - leg_mm * before.end_direction();
    const Point enter = next.start + leg_mm * next.start_direction();
    before.set_end(leave);
    next.set_start(enter);
    return Element{leave, enter, {}, 0};
}

}  // namespace tribo::readers::gcode
