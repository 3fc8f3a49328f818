// SPDX-License-Identifier: MIT
// Lines and arcs in a plane: offset by the radius of a cutter, and intersection. Pure geometry, mm; any
// thread, no allocation.
#pragma once

#include <array>
#include <optional>

namespace tribo::readers::gcode {

struct Point {
    double u = 0, v = 0;

    bool operator==(const Point&) const = default;
};

// A line, or an arc about a centre. turn_rad > 0 turns left.
struct Element {
    Point start, end;
    Point centre;
    double turn_rad = 0;  // 0: a line

    bool is_arc() const { return turn_rad != 0; }
    double length() const;
    // Unit directions of travel.
    Point start_direction() const;
    Point end_direction() const;
    // 1 / radius, positive for a left turn.
    double curvature_per_mm() const;
    // Distance of `p` before the end or after the start. `p` lies on the element or on its continuation.
    double before_end(Point p) const;
    double after_start(Point p) const;
    // Shortens the element to a new end or start on it.
    void set_end(Point p);
    void set_start(Point p);
};

// Returns the element moved to the left by `left_mm` (negative: to the right); none if an arc is too small
// for the offset.
std::optional<Element> offset(const Element& element, double left_mm);

// Returns the angle of the left turn from direction a to direction b, in (-pi, pi].
double turn_between(Point a, Point b);

// Returns the point where `first` is to end and `second` to begin: of their common points the one that
// shortens them least; none if they have no common point.
std::optional<Point> meeting(const Element& first, const Element& second);

// The common points of two elements, but for those that run along each other.
struct Crossings {
    std::array<Point, 2> points;
    int count = 0;
    void add(Point p) { points[static_cast<std::size_t>(count++)] = p; }
};
Crossings crossings(const Element& a, const Element& b);

// Returns the arc about a centre from a point to another, to the left for side > 0.
Element arc_about(Point centre, Point from, Point to, int side);

// Puts an arc of that radius, or a chamfer that takes `leg_mm` from each line, between two elements: shortens
// both and returns what lies between; none if it does not fit. They do not run straight on.
std::optional<Element> rounded(Element& before, Element& next, double radius_mm);
std::optional<Element> chamfered(Element& before, Element& next, double leg_mm);

// Returns the arc from `start` to the end of `arc`, with the direction of `arc` at the end; none if it would
// be a line.
std::optional<Element> arc_into(Point start, const Element& arc);

double distance(Point a, Point b);

}  // namespace tribo::readers::gcode
