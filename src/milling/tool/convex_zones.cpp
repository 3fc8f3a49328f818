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
// A normal with a smaller part across the axis is that of a level tangent.
constexpr double kLevel = 1e-6;
// Points nearer than this to the start of a ray are the start, mm.
constexpr double kNearMm = 1e-7;
// Half of the shortest chord that is more than a touch, mm.
constexpr double kTouchMm = 1e-4;
// Up to this share of its radius from a concave arc the distance is the way to it.
constexpr double kTrueShare = 0.5;
// The ends of a concave arc are looked for from tangents, this far apart at most, rad. A zone with a level
// end goes so little beyond it.
constexpr double kTangentStep = 0.01;

// A ray at s from 0: from + s * way, |way| = 1.
struct Ray {
    PlanePoint from, way;
};

void take_nearer(double s, double& nearest) {
    if (s > kNearMm) nearest = std::min(nearest, s);
}

// Shortens `nearest` to the first point of the element on the ray.
void meet(const Ray& ray, const ProfileElement& e, double& nearest) {
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
    const double square = middle * middle - dot(from, from) + e.radius_mm * e.radius_mm;
    // A ray that only touches the arc stays inside.
    if (square < kTouchMm * kTouchMm) return;
    for (const double s : {middle - std::sqrt(square), middle + std::sqrt(square)}) {
        const double height = ray.from.z + s * ray.way.z;
        if (height >= e.from.z && height <= e.to.z) take_nearer(s, nearest);
    }
}

// The direction of the profile where it has this outward normal.
PlanePoint along(PlanePoint normal) {
    return {-normal.z, normal.r};
}

// Returns the point half way to where the straight continuation from `from` leaves the cutter; nothing if it
// reaches the axis first, or does not rise or fall.
std::optional<PlanePoint> half_way(const std::vector<ProfileElement>& elements, PlanePoint from,
                                   PlanePoint way) {
    if (std::abs(way.z) < kSmooth) return std::nullopt;
    double nearest = 1e6;
    for (const ProfileElement& e : elements) meet({from, way}, e, nearest);
    if (way.r < 0 && from.r + nearest * way.r <= 0) return std::nullopt;
    return from + (0.5 * nearest) * way;
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

// A run of elements from `first` to before `end` without a concave joint.
struct ConvexZones::Run {
    std::size_t first, end;
};

void ConvexZones::add_face(const ProfileElement& e) {
    faces_.push_back({e.from_normal, e.to_normal, dot(e.from_normal, e.from), e.centre, e.radius_mm});
}

// Keeps a zone below (up = 1) or above (up = -1) a height.
void ConvexZones::add_level(double up, double height_mm) {
    const PlanePoint normal{0, up};
    faces_.push_back({normal, normal, up * height_mm, {}, 0});
}

// Ends a zone below its first element: at the joint if that is convex, else within the cutter. Returns the
// radius there.
double ConvexZones::add_lower_end(const std::vector<ProfileElement>& elements, std::size_t number,
                                  PlanePoint normal) {
    const PlanePoint joint = elements[number].from;
    const bool convex = number > 0 && cross(elements[number - 1].to_normal, normal) > kSmooth;
    return add_end(-1, convex ? joint : half_way(elements, joint, -1.0 * along(normal)));
}

// The same above its last element.
double ConvexZones::add_upper_end(const std::vector<ProfileElement>& elements, std::size_t number,
                                  PlanePoint normal) {
    const PlanePoint joint = elements[number].to;
    const bool convex =
        number + 1 < elements.size() && cross(normal, elements[number + 1].from_normal) > kSmooth;
    return add_end(1, convex ? joint : half_way(elements, joint, along(normal)));
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
    double radius = largest_radius_mm({elements.begin() + static_cast<std::ptrdiff_t>(run.first),
                                       elements.begin() + static_cast<std::ptrdiff_t>(run.end)});
    if (run.first > 0)
        radius = std::max(radius, add_lower_end(elements, run.first, elements[run.first].from_normal));
    if (run.end < elements.size())
        radius = std::max(radius, add_upper_end(elements, run.end - 1, elements[run.end - 1].to_normal));
    if (run.first > 0 || run.end < elements.size()) add_side(radius);
    zones_.push_back({first, faces_.size()});
}

// A level tangent has no height: the ends are those of the first and the last one that is not level.
void ConvexZones::add_concave(const std::vector<ProfileElement>& elements, std::size_t number) {
    const ProfileElement& arc = elements[number];
    const double angle =
        math::atan2(cross(arc.from_normal, arc.to_normal), dot(arc.from_normal, arc.to_normal));
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / kTangentStep)));
    struct Tangent {
        PlanePoint at, normal;
    };
    const auto tangent = [&](int n) -> Tangent {
        double sine, cosine;
        math::sincos(angle * n / count, sine, cosine);
        const PlanePoint a = arc.from_normal;
        const PlanePoint normal{a.r * cosine - a.z * sine, a.z * cosine + a.r * sine};
        return {arc.centre + arc.radius_mm * normal, normal};
    };
    const auto is_level = [&](int n) { return std::abs(tangent(n).normal.r) < kLevel; };
    int low = 0, high = count;
    while (low < count && is_level(low)) ++low;
    while (high > 0 && is_level(high)) --high;
    const std::size_t first = faces_.size();
    add_face(arc);
    const Tangent lowest = tangent(low), highest = tangent(high);
    const double below = low == 0 ? add_lower_end(elements, number, lowest.normal)
                                  : add_end(-1, half_way(elements, lowest.at, -1.0 * along(lowest.normal)));
    const double above = high == count ? add_upper_end(elements, number, highest.normal)
                                       : add_end(1, half_way(elements, highest.at, along(highest.normal)));
    add_side(std::max({arc.from.r, arc.to.r, below, above}));
    zones_.push_back({first, faces_.size(), 1 / (-arc.radius_mm * kTrueShare)});
}

ConvexZones::ConvexZones(const Cutter& cutter) : length_mm_(cutter.length_mm) {
    std::vector<ProfileElement> elements = profile_elements(cutter);
    radius_mm_ = largest_radius_mm(elements);
    const PlanePoint top = elements.back().to, up{0, 1};
    elements.push_back({top, {0, top.z}, up, up, {}, 0});
    std::size_t begin = 0;
    for (std::size_t n = 0; n < elements.size(); ++n) {
        const bool concave = elements[n].radius_mm < 0;
        const bool joins = n > begin && cross(elements[n - 1].to_normal, elements[n].from_normal) > -kSmooth;
        if ((concave || !joins) && n > begin) add_run(elements, {begin, n});
        if (concave || !joins) begin = n;
        if (!concave) continue;
        add_concave(elements, n);
        begin = n + 1;
    }
    if (begin < elements.size()) add_run(elements, {begin, elements.size()});
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
