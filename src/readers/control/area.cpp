// SPDX-License-Identifier: MIT
#include "readers/control/area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/math.hpp"

namespace tribo::readers::control {
namespace {

using gcode::Element;
using gcode::Point;

// Points that are this close count as one, mm: above the rounding of crossings, below what is milled.
constexpr double kJoinMm = 1e-5;
// A piece may be nearer to the edge than the distance by this, mm.
constexpr double kNearMm = 2e-6;
constexpr double kShortestMm = 1e-6;
// On which side of an element the area lies is tried so far from it, mm.
constexpr double kAsideMm = 1e-4;
constexpr double kStraightRad = 1e-9;
// A straight way is tried at places of this distance, mm: between them it may be nearer by as much.
constexpr double kTriedMm = 0.01;

Point point_at(const Element& element, double share) {
    if (!element.is_arc())
        return {element.start.u + share * (element.end.u - element.start.u),
                element.start.v + share * (element.end.v - element.start.v)};
    double sine = 0, cosine = 0;
    math::sincos(share * element.turn_rad, sine, cosine);
    const double u = element.start.u - element.centre.u, v = element.start.v - element.centre.v;
    return {element.centre.u + cosine * u - sine * v, element.centre.v + sine * u + cosine * v};
}

Element part_of(const Element& element, double from, double to) {
    Element part = element;
    part.start = from <= 0 ? element.start : point_at(element, from);
    part.end = to >= 1 ? element.end : point_at(element, to);
    part.turn_rad = element.turn_rad * (to - from);
    return part;
}

double distance_to(const Element& element, Point p) {
    const double ends = std::min(distance(p, element.start), distance(p, element.end));
    const double along = element.after_start(p);
    if (!(along >= 0) || !(along <= element.length())) return ends;
    if (element.is_arc())
        return std::min(ends, std::abs(distance(p, element.centre) - distance(element.end, element.centre)));
    return distance(p, point_at(element, along / std::max(element.length(), kShortestMm)));
}

// The angle by which the element turns about a point.
double angle_about(const Element& element, Point p) {
    if (std::abs(element.turn_rad) > math::kPi) {
        return angle_about(part_of(element, 0, 0.5), p) + angle_about(part_of(element, 0.5, 1), p);
    }
    const Point a{element.start.u - p.u, element.start.v - p.v}, b{element.end.u - p.u, element.end.v - p.v};
    const double chord = gcode::turn_between(a, b);
    if (!element.is_arc()) return chord;
    // Between chord and arc it is a whole turn more or less.
    const double side = a.u * b.v - a.v * b.u;  // positive: left of the chord
    const double way = element.turn_rad > 0 ? 1 : -1;
    if (side == 0) return std::abs(chord) > math::kHalfPi ? way * math::kPi : 0;
    const bool between =
        distance(p, element.centre) < distance(element.end, element.centre) && side * way < 0;
    return between ? chord + way * math::kTwoPi : chord;
}

bool is_within(const Ring& ring, Point p) {
    double turn = 0;
    for (const Element& element : ring) turn += angle_about(element, p);
    return std::abs(turn) > math::kPi;
}

struct Box {
    double u_min = 0, u_max = 0, v_min = 0, v_max = 0;
    bool touches(const Box& other) const {
        return u_min <= other.u_max && other.u_min <= u_max && v_min <= other.v_max && other.v_min <= v_max;
    }
};

// A box about the element; of an arc about its whole circle.
Box box_of(const Element& element) {
    const Point a = element.start, b = element.end;
    if (!element.is_arc())
        return {std::min(a.u, b.u) - kJoinMm, std::max(a.u, b.u) + kJoinMm, std::min(a.v, b.v) - kJoinMm,
                std::max(a.v, b.v) + kJoinMm};
    const double radius = distance(b, element.centre) + kJoinMm;
    return {element.centre.u - radius, element.centre.u + radius, element.centre.v - radius,
            element.centre.v + radius};
}

// The pieces of elements between their crossings.
std::vector<Element> split(const std::vector<Element>& elements) {
    std::vector<std::vector<double>> cuts(elements.size());
    std::vector<Box> boxes;
    boxes.reserve(elements.size());
    for (const Element& element : elements) boxes.push_back(box_of(element));
    const auto cut = [&](std::size_t i, Point p) {
        const double length = elements[i].length();
        const double share = length > 0 ? elements[i].after_start(p) / length : 0;
        if (share > 0 && share < 1) cuts[i].push_back(share);
    };
    for (std::size_t i = 0; i < elements.size(); ++i) {
        for (std::size_t k = i + 1; k < elements.size(); ++k) {
            if (!boxes[i].touches(boxes[k])) continue;
            const gcode::Crossings found = gcode::crossings(elements[i], elements[k]);
            for (int n = 0; n < found.count; ++n) {
                cut(i, found.points[static_cast<std::size_t>(n)]);
                cut(k, found.points[static_cast<std::size_t>(n)]);
            }
            // Elements that touch along each other part at their ends.
            for (const Point p : {elements[k].start, elements[k].end}) {
                if (distance_to(elements[i], p) < kJoinMm) cut(i, p);
            }
            for (const Point p : {elements[i].start, elements[i].end}) {
                if (distance_to(elements[k], p) < kJoinMm) cut(k, p);
            }
        }
    }
    std::vector<Element> pieces;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        std::sort(cuts[i].begin(), cuts[i].end());
        cuts[i].push_back(1);
        double from = 0;
        for (const double to : cuts[i]) {
            if ((to - from) * elements[i].length() < kShortestMm) continue;
            pieces.push_back(part_of(elements[i], from, to));
            from = to;
        }
    }
    return pieces;
}

// Joins pieces end to start into closed rings; where several begin, the one that turns most to the left.
std::vector<Ring> chained(std::vector<Element> pieces) {
    std::vector<Ring> rings;
    std::vector<bool> used(pieces.size());
    for (std::size_t first = 0; first < pieces.size(); ++first) {
        if (used[first]) continue;
        Ring ring{pieces[first]};
        std::vector<std::size_t> taken{first};
        used[first] = true;
        while (distance(ring.back().end, ring.front().start) > kJoinMm) {
            std::optional<std::size_t> next;
            double most = 0;
            for (std::size_t k = 0; k < pieces.size(); ++k) {
                if (used[k] || distance(pieces[k].start, ring.back().end) > kJoinMm) continue;
                const double turn =
                    gcode::turn_between(ring.back().end_direction(), pieces[k].start_direction());
                if (next && turn <= most) continue;
                next = k;
                most = turn;
            }
            if (!next) break;
            used[*next] = true;
            ring.push_back(pieces[*next]);
        }
        if (distance(ring.back().end, ring.front().start) <= kJoinMm) rings.push_back(std::move(ring));
    }
    return rings;
}

}  // namespace

Area::Area(std::vector<Ring> pockets, std::vector<Ring> islands)
    : pockets_(std::move(pockets)), islands_(std::move(islands)) {
    find_edge();
}

Area::Area(std::vector<Ring> contours) : pockets_(std::move(contours)), alternates_(true) {
    find_edge();
}

void Area::find_edge() {
    std::vector<Element> all;
    for (const auto* rings : {&pockets_, &islands_}) {
        for (const Ring& ring : *rings) all.insert(all.end(), ring.begin(), ring.end());
    }
    for (const Element& piece : split(all)) {
        const auto left = gcode::offset(part_of(piece, 0.4, 0.6), kAsideMm);
        const auto right = gcode::offset(part_of(piece, 0.4, 0.6), -kAsideMm);
        const bool on_left = left && has(point_at(*left, 0.5)),
                   on_right = right && has(point_at(*right, 0.5));
        if (on_left == on_right) continue;
        const auto is_same = [&](const Element& known) {
            return distance(point_at(known, 0.5), point_at(piece, 0.5)) < kJoinMm;
        };
        if (std::any_of(edge_.begin(), edge_.end(), is_same)) continue;
        edge_.push_back(piece);
        if (on_left) continue;
        std::swap(edge_.back().start, edge_.back().end);
        edge_.back().turn_rad *= -1;
    }
}

bool Area::has(Point p) const {
    const auto within = [&](const Ring& ring) { return is_within(ring, p); };
    const auto about = std::count_if(pockets_.begin(), pockets_.end(), within);
    if (alternates_) return about % 2 == 1;
    return about > 0 && std::none_of(islands_.begin(), islands_.end(), within);
}

double Area::to_edge(Point p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Element& element : edge_) least = std::min(least, distance_to(element, p));
    return least;
}

std::vector<Ring> Area::rings_at(double distance_mm) const {
    std::vector<Element> moved;
    for (const Element& element : edge_) {
        if (const auto offset = gcode::offset(element, distance_mm)) moved.push_back(*offset);
        for (const Element& next : edge_) {
            if (distance(next.start, element.end) > kJoinMm) continue;
            const Point before = element.end_direction(), behind = next.start_direction();
            const double turn = gcode::turn_between(before, behind);
            if (turn > -kStraightRad) continue;
            const Point corner = element.end;
            moved.push_back({{corner.u - distance_mm * before.v, corner.v + distance_mm * before.u},
                             {corner.u - distance_mm * behind.v, corner.v + distance_mm * behind.u},
                             corner,
                             turn});
        }
    }
    std::vector<Element> kept;
    for (const Element& piece : split(moved)) {
        const Point middle = point_at(piece, 0.5);
        if (to_edge(middle) >= distance_mm - kNearMm && has(middle)) kept.push_back(piece);
    }
    return chained(std::move(kept));
}

bool Area::keeps(Point from, Point to, double distance_mm) const {
    const Point middle{(from.u + to.u) / 2, (from.v + to.v) / 2};
    const double room = to_edge(middle) - distance_mm, half = distance(from, to) / 2;
    if (room < -kJoinMm || !has(middle)) return false;
    return room >= half || half < kTriedMm ||
           (keeps(from, middle, distance_mm) && keeps(middle, to, distance_mm));
}

}  // namespace tribo::readers::control
