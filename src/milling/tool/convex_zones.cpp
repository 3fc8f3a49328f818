// SPDX-License-Identifier: MIT
#include "milling/tool/convex_zones.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/math.hpp"

namespace tribo::milling {
namespace {

// A joint that turns by less (sine) counts as smooth.
constexpr double kSmooth = 1e-9;
// Elements are in one run though one lies beyond the tangent of another by less, mm: the numbers of a profile
// are rounded.
constexpr double kBeyondMm = 2e-5;
// A normal with a smaller part across the axis is that of a nearly level tangent.
constexpr double kNearlyLevel = 0.2;
// A joint that turns by less (sine) turns little.
constexpr double kLittle = 0.1;
// Points nearer than this to the start of a ray are the start, mm.
constexpr double kNearMm = 1e-7;
// Half of the shortest chord that is more than a touch, mm.
constexpr double kTouchMm = 1e-4;
// Farther than the end of any ray within a cutter, mm.
constexpr double kNowhere = 1e6;
// Up to this share of its radius from a concave arc the distance is the way to it.
constexpr double kTrueShare = 0.5;

// A ray at s from 0: from + s * way, |way| = 1.
struct Ray {
    PlanePoint from, way;
};

void take_nearer(double s, double& nearest) {
    if (s > kNearMm) nearest = std::min(nearest, s);
}

// Shortens `nearest` to the first point of the element on the ray. `touch_mm`: half of the chord of a
// concave arc up to which the ray stays inside.
void meet(const Ray& ray, const ProfileElement& e, double touch_mm, double& nearest) {
    if (!e.is_arc()) {
        const double approach = dot(ray.way, e.from_normal);
        if (std::abs(approach) < 1e-14) return;
        const double s = dot(e.from - ray.from, e.from_normal) / approach;
        const PlanePoint at = ray.from + s * ray.way, side = e.to - e.from;
        // A ray along the wall of a cylinder meets the bottom at its very end.
        const double along = dot(at - e.from, side), slack = kNearMm * norm(side);
        if (along >= -slack && along <= dot(side, side) + slack) take_nearer(s, nearest);
        return;
    }
    const PlanePoint from = ray.from - e.centre;
    const double middle = -dot(from, ray.way);
    double square = middle * middle - dot(from, from) + e.radius_mm * e.radius_mm;
    // A ray that comes along the tangent of a convex arc leaves there, though it may miss the arc by
    // rounding.
    if (square < touch_mm * touch_mm && e.radius_mm > 0) square += 2 * kBeyondMm * e.radius_mm;
    if (square < touch_mm * touch_mm) return;
    for (const double s : {middle - std::sqrt(square), middle + std::sqrt(square)}) {
        const PlanePoint at = ray.from + s * ray.way;
        const bool faces_out = (at.r - e.centre.r) * e.radius_mm > -kNearMm;
        if (faces_out && at.z >= e.from.z - kNearMm && at.z <= e.to.z + kNearMm) take_nearer(s, nearest);
    }
}

// The direction of the profile where it has this outward normal.
PlanePoint along(PlanePoint normal) {
    return {-normal.z, normal.r};
}

// Returns the point half way to where the straight continuation from `from` leaves the cutter; nothing if it
// reaches the axis first, or does not rise or fall. `beyond` is the element behind the joint.
std::optional<PlanePoint> half_way(const std::vector<ProfileElement>& elements, PlanePoint from,
                                   PlanePoint way, const ProfileElement& beyond) {
    if (std::abs(way.z) < kSmooth) return std::nullopt;
    double nearest = kNowhere;
    for (const ProfileElement& e : elements) meet({from, way}, e, kTouchMm, nearest);
    // A convex arc turns away from the continuation at once, or where its chord ends.
    if (beyond.radius_mm > 0) {
        const double chord = -2 * dot(from - beyond.centre, way);
        if (chord < 2 * kTouchMm) nearest = std::max(chord, 0.0);
    }
    if (way.r < 0 && -from.r / way.r <= nearest) {
        const double axis_z = from.z - from.r / way.r * way.z;
        if (axis_z >= 0 && axis_z <= elements.back().to.z) return std::nullopt;
    }
    if (nearest == kNowhere) return from;
    return from + (0.5 * nearest) * way;
}

bool is_concave_arc(const ProfileElement& e) {
    return e.radius_mm < 0;
}

double bend_per_mm_of(const ProfileElement& e) {
    return is_concave_arc(e) ? 1 / (-e.radius_mm * kTrueShare) : 0;
}

// The sine of the turn of the normal at a joint, 1 or -1 where it turns by more than a right angle; > 0:
// convex.
double turn_at(const ProfileElement& before, const ProfileElement& after) {
    const PlanePoint from = before.to_normal, to = after.from_normal;
    if (dot(from, to) < 0) return from.z < to.z ? 1 : -1;
    return cross(from, to);
}

bool is_convex_joint(const ProfileElement& before, const ProfileElement& after) {
    return turn_at(before, after) > kSmooth;
}

bool is_nearly_level(PlanePoint normal) {
    return std::abs(normal.r) < kNearlyLevel;
}

bool ends_level(const ProfileElement& e, PlanePoint normal) {
    return is_concave_arc(e) && is_nearly_level(normal);
}

}  // namespace

ConvexZones::Seen ConvexZones::Face::look(PlanePoint at) const {
    if (radius_mm == 0) return {dot(first, at) - offset_mm, first};
    const PlanePoint d = at - centre;
    if (radius_mm < 0) return look_into_hollow(d);
    const double size = norm(d);
    if (size > 0 && cross(first, d) >= 0 && cross(d, last) >= 0) return {size - radius_mm, (1 / size) * d};
    const double by_first = dot(first, d), by_last = dot(last, d);
    return by_first >= by_last ? Seen{by_first - radius_mm, first} : Seen{by_last - radius_mm, last};
}

// The least of the distances to all tangents of the arc: of those within it one is tangent where the way from
// the centre leads. Beyond kTrueShare of the radius a parabola goes on, so that the centre is no peak.
ConvexZones::Seen ConvexZones::Face::look_into_hollow(PlanePoint off) const {
    const double radius = -radius_mm, size = norm(off), far = (1 - kTrueShare) * radius;
    Seen seen;
    if (size > 0 && cross(first, off) >= 0 && cross(off, last) >= 0) {
        seen = {radius - size, (-1 / size) * off};
    } else {
        const double by_first = dot(first, off), by_last = dot(last, off);
        seen = by_first <= by_last ? Seen{radius + by_first, first} : Seen{radius + by_last, last};
    }
    const double beyond = std::min(seen.distance_mm - kTrueShare * radius, far);
    if (beyond <= 0) return seen;
    const double slope = 1 - beyond / far;
    return {kTrueShare * radius + 0.5 * (1 + slope) * beyond, slope * seen.normal};
}

// Elements from `first` to before `end` without a concave joint, or a concave arc alone.
struct ConvexZones::Run {
    std::size_t first, end;

    double largest_radius_mm(const std::vector<ProfileElement>& elements) const {
        return milling::largest_radius_mm({elements.begin() + static_cast<std::ptrdiff_t>(first),
                                           elements.begin() + static_cast<std::ptrdiff_t>(end)});
    }
};

ConvexZones::Face ConvexZones::face_of(const ProfileElement& e) {
    return {e.from_normal, e.to_normal, dot(e.from_normal, e.from), e.centre, e.radius_mm};
}

// How far a line or a convex arc reaches out of a face. The distance to the face is convex along it: it is
// largest at an end or, on an arc, in the direction in which the face looks.
double ConvexZones::beyond_mm(const Face& face, const ProfileElement& e) {
    double most = std::max(face.look(e.from).distance_mm, face.look(e.to).distance_mm);
    if (!e.is_arc()) return most;
    for (const PlanePoint way : {face.first, face.last, e.centre - face.centre}) {
        const double size = norm(way);
        if (size == 0 || cross(e.from_normal, way) < 0 || cross(way, e.to_normal) < 0) continue;
        most = std::max(most, face.look(e.centre + (e.radius_mm / size) * way).distance_mm);
    }
    return most;
}

// Returns the joint at which elements are two runs; `run.first` if they are one.
std::size_t ConvexZones::joint_between_runs(const std::vector<ProfileElement>& elements, const Run& run) {
    std::size_t sharpest = run.first;
    double turn = -kSmooth;
    bool are_one = true;
    for (std::size_t n = run.first + 1; n < run.end; ++n) {
        if (is_concave_arc(elements[n - 1]) || is_concave_arc(elements[n])) return n;
        const double here = turn_at(elements[n - 1], elements[n]);
        if (here < turn) sharpest = n, turn = here;
        for (std::size_t k = run.first; k < n && are_one; ++k)
            are_one = beyond_mm(face_of(elements[k]), elements[n]) < kBeyondMm &&
                      beyond_mm(face_of(elements[n]), elements[k]) < kBeyondMm;
    }
    return are_one ? run.first : sharpest;
}

void ConvexZones::split_into_runs(const std::vector<ProfileElement>& elements, const Run& run,
                                  std::vector<Run>& runs) {
    const std::size_t joint = joint_between_runs(elements, run);
    if (joint == run.first) {
        runs.push_back(run);
        return;
    }
    split_into_runs(elements, {run.first, joint}, runs);
    split_into_runs(elements, {joint, run.end}, runs);
}

void ConvexZones::add_face(const ProfileElement& e) {
    faces_.push_back(face_of(e));
}

// Keeps a zone below (up = 1) or above (up = -1) a height.
void ConvexZones::add_level(double up, double height_mm) {
    const PlanePoint normal{0, up};
    faces_.push_back({normal, normal, up * height_mm, {}, 0});
}

// Ends a zone below its first element: at the joint if that is convex, else within the cutter. Returns the
// radius there.
double ConvexZones::add_lower_end(const std::vector<ProfileElement>& elements, std::size_t number) {
    const ProfileElement& own = elements[number];
    if (number == 0) return is_concave_arc(own) ? add_end(-1, own.from) : 0;
    const ProfileElement& below = elements[number - 1];
    if (is_convex_joint(below, own) || ends_level(own, own.from_normal)) return add_end(-1, own.from);
    return add_end(-1, half_way(elements, own.from, -1.0 * along(own.from_normal), below));
}

// The same above its last element.
double ConvexZones::add_upper_end(const std::vector<ProfileElement>& elements, std::size_t number) {
    if (number + 1 == elements.size()) return 0;
    const ProfileElement &own = elements[number], &above = elements[number + 1];
    if (is_convex_joint(own, above) || ends_level(own, own.to_normal)) return add_end(1, own.to);
    return add_end(1, half_way(elements, own.to, along(own.to_normal), above));
}

double ConvexZones::add_end(double up, const std::optional<PlanePoint>& end) {
    if (!end) return 0;
    add_level(up, end->z);
    return end->r;
}

// Adds a cylinder around a zone, so that the distance beside its sharp ends is not much too small.
void ConvexZones::add_side(double radius_mm) {
    faces_.push_back({{1, 0}, {1, 0}, radius_mm, {}, 0});
}

void ConvexZones::add_run(const std::vector<ProfileElement>& elements, const Run& run) {
    const std::size_t first = faces_.size();
    for (std::size_t n = run.first; n < run.end; ++n) add_face(elements[n]);
    if (run.end - run.first < elements.size()) {
        const double below = add_lower_end(elements, run.first), above = add_upper_end(elements, run.end - 1);
        add_side(std::max({run.largest_radius_mm(elements), below, above}));
    }
    zones_.push_back({first, faces_.size(), bend_per_mm_of(elements[run.first])});
}

// Adds what is within both elements, from the lower end of one to the upper end of the other.
void ConvexZones::add_bridge(const ProfileElement& below, const ProfileElement& above) {
    const std::size_t first = faces_.size();
    add_face(below);
    add_face(above);
    add_level(-1, below.from.z);
    add_level(1, above.to.z);
    add_side(largest_radius_mm({below, above}));
    zones_.push_back({first, faces_.size(), std::max(bend_per_mm_of(below), bend_per_mm_of(above))});
}

// Adds a cylinder around the axis through the end of an element: on one side it is within the element, on the
// other it goes half way to where the cutter ends.
void ConvexZones::add_column(const std::vector<ProfileElement>& elements, std::size_t number, double up) {
    const ProfileElement &own = elements[number], &beyond = elements[up > 0 ? number + 1 : number - 1];
    const PlanePoint end = up > 0 ? own.to : own.from, other = up > 0 ? own.from : own.to;
    const std::size_t first = faces_.size();
    add_face(own);
    add_level(-up, other.z);
    add_level(up, half_way(elements, end, {0, up}, beyond)->z);
    add_side(end.r);
    zones_.push_back({first, faces_.size(), bend_per_mm_of(own)});
}

// Adds a cylinder through a slit between two levels, half way to where the cutter ends below and above.
void ConvexZones::add_core(const std::vector<ProfileElement>& elements, std::size_t number) {
    const ProfileElement &below = elements[number], &above = elements[number + 1];
    const std::size_t first = faces_.size();
    add_level(-1, half_way(elements, below.to, {0, -1}, below)->z);
    add_level(1, half_way(elements, above.from, {0, 1}, above)->z);
    add_side(below.to.r);
    zones_.push_back({first, faces_.size()});
}

// Two zones that end at one height leave a surface of no thickness there, and two that overlap little a thin
// one. A further zone overlaps both where element `number` ends.
void ConvexZones::join(const std::vector<ProfileElement>& elements, std::size_t number) {
    const ProfileElement &own = elements[number], &next = elements[number + 1];
    const double turn = turn_at(own, next);
    const bool both_level = is_nearly_level(own.to_normal) && is_nearly_level(next.from_normal);
    if (both_level && own.to_normal.z > 0 && next.from_normal.z < 0) {
        add_core(elements, number);
    } else if (turn < kLittle && is_nearly_level(own.to_normal) && own.to_normal.z < 0) {
        add_column(elements, number, 1);
    } else if (turn < kLittle && is_nearly_level(next.from_normal) && next.from_normal.z > 0) {
        add_column(elements, number + 1, -1);
    } else if (!is_concave_arc(own) && !is_concave_arc(next)) {
        if (turn > -kLittle) add_bridge(own, next);
    } else if (turn > kSmooth) {
        // A level line gives way to what is behind it, which has the same height.
        std::size_t below = number + 1, above = number + 1;
        while (below > 0 && elements[below - 1].is_level()) --below;
        while (above < elements.size() && elements[above].is_level()) ++above;
        if (below > 0 && above < elements.size()) add_bridge(elements[below - 1], elements[above]);
    }
}

ConvexZones::ConvexZones(const Cutter& cutter) : length_mm_(cutter.length_mm) {
    std::vector<ProfileElement> elements = profile_elements(cutter);
    radius_mm_ = largest_radius_mm(elements);
    const PlanePoint top = elements.back().to, up{0, 1};
    elements.push_back({top, {0, top.z}, up, up, {}, 0});
    std::vector<Run> runs;
    split_into_runs(elements, {0, elements.size()}, runs);
    for (const Run& run : runs) {
        add_run(elements, run);
        if (run.end < elements.size()) join(elements, run.end - 1);
    }
}

ConvexZones::Seen ConvexZones::look(std::size_t zone, PlanePoint at) const {
    Seen most = faces_[zones_[zone].first].look(at);
    for (std::size_t n = zones_[zone].first + 1; n < zones_[zone].end; ++n) {
        const Seen seen = faces_[n].look(at);
        if (seen.distance_mm > most.distance_mm) most = seen;
    }
    return most;
}

PlanePoint ConvexZones::other_normal(std::size_t zone, PlanePoint at, double slack_mm) const {
    const Seen most = look(zone, at);
    for (std::size_t n = zones_[zone].first; n < zones_[zone].end; ++n) {
        const Seen seen = faces_[n].look(at);
        if (seen.distance_mm > most.distance_mm - slack_mm && dot(seen.normal, most.normal) < 1 - kSmooth)
            return seen.normal;
    }
    return most.normal;
}

ConvexZones::Seen ConvexZones::look(PlanePoint at) const {
    Seen least = look(0, at);
    for (std::size_t zone = 1; zone < zones_.size(); ++zone) {
        std::size_t n = zones_[zone].first;
        Seen most = faces_[n].look(at);
        for (++n; n < zones_[zone].end && most.distance_mm < least.distance_mm; ++n) {
            const Seen seen = faces_[n].look(at);
            if (seen.distance_mm > most.distance_mm) most = seen;
        }
        if (most.distance_mm < least.distance_mm) least = most;
    }
    return least;
}

double ConvexZones::distance_mm(PlanePoint at) const {
    return look(at).distance_mm;
}

}  // namespace tribo::milling
