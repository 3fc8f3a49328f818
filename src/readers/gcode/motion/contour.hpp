// SPDX-License-Identifier: MIT
// Lines and arcs in a plane, offset sideways by the radius of a cutter, and where two of them meet. Pure
// geometry, mm; any thread, no allocation.
#pragma once

#include <optional>

namespace tribo::readers::gcode {

struct Point {
    double u = 0, v = 0;

    bool operator==(const Point&) const = default;
};

// A line, or an arc about a centre that turns left for turn_rad > 0.
struct Element {
    Point start, end;
    Point centre;
    double turn_rad = 0;  // 0: a line

    bool is_arc() const { return turn_rad != 0; }
    double length() const;
    // Unit directions of travel.
    Point start_direction() const;
    Point end_direction() const;
    // 1 / radius, above 0 where it turns left.
    double curvature_per_mm() const;
    // How far `p`, which lies on the element or its continuation, is before its end or after its start.
    double before_end(Point p) const;
    double after_start(Point p) const;
    // Cut off: at a new end or start on the element.
    void set_end(Point p);
    void set_start(Point p);
};

// The element moved to its left by `left_mm` (right: below 0); none where an arc is too small for that.
std::optional<Element> offset(const Element& element, double left_mm);

// The angle by which a path turns left from direction a to direction b, in (-pi, pi].
double turn_between(Point a, Point b);

// Where `first` is to end and `second` to begin so that they join: the common point of both that cuts the
// least off them; none where they have none.
std::optional<Point> meeting(const Element& first, const Element& second);

// The arc from `start` to the end of `arc`, with the direction of `arc` there; none where it would be a line.
std::optional<Element> arc_into(Point start, const Element& arc);

double distance(Point a, Point b);

}  // namespace tribo::readers::gcode
