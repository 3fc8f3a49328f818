// SPDX-License-Identifier: MIT
#include "readers/mesh/model_polygon.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::readers {

// Newell's method gives the area vector of any polygon, also if it is not planar.
void PolygonTriangulator::project(std::span<const std::uint32_t> corners, std::span<const Vec3> points) {
    Vec3 area;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        area += cross(points[i] - points[0], points[i + 1] - points[0]);
    }
    const double x = std::abs(area.x), y = std::abs(area.y), z = std::abs(area.z);
    const int dropped = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const int u_axis = (dropped + 1) % 3, v_axis = (dropped + 2) % 3;
    const double side = area[dropped] < 0 ? -1 : 1;
    corners_.clear();
    double extent = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 p = points[i] - points[0];
        const std::size_t next = i + 1 == corners.size() ? 0 : i + 1;
        if (corners[i] == corners[next] || points[i] == points[next]) continue;
        corners_.push_back({side * p[u_axis], p[v_axis], corners[i], 0, 0});
        extent = std::max({extent, std::abs(p[u_axis]), std::abs(p[v_axis])});
    }
    const auto n = static_cast<std::uint32_t>(corners_.size());
    for (std::uint32_t i = 0; i < n; ++i) {
        corners_[i].before = i == 0 ? n - 1 : i - 1;
        corners_[i].after = i + 1 == n ? 0 : i + 1;
    }
    flat_ = 1e-12 * extent * extent;
}

// Twice the signed area of the triangle.
double PolygonTriangulator::turn(const Corner& a, const Corner& b, const Corner& c) const {
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// True when all corners, seen from the first, follow each other within half a turn.
bool PolygonTriangulator::fan_fits() const {
    for (std::size_t i = 2; i < corners_.size(); ++i) {
        if (turn(corners_[0], corners_[i - 1], corners_[i]) <= flat_) return false;
        if (turn(corners_[0], corners_[1], corners_[i]) <= flat_) return false;
    }
    return true;
}

bool PolygonTriangulator::is_ear(std::uint32_t corner) {
    const Corner& b = corners_[corner];
    const Corner& a = corners_[b.before];
    const Corner& c = corners_[b.after];
    ++tests_;
    if (turn(a, b, c) <= flat_) return false;
    for (std::uint32_t i = c.after; i != b.before; i = corners_[i].after) {
        const Corner& p = corners_[i];
        ++tests_;
        if (turn(a, b, p) < 0 || turn(b, c, p) < 0 || turn(c, a, p) < 0) continue;
        const auto at = [&](const Corner& q) { return p.u == q.u && p.v == q.v; };
        if (!at(a) && !at(b) && !at(c)) return false;  // bridges to holes use a corner twice
    }
    return true;
}

bool PolygonTriangulator::clip_ears(std::vector<Triangle>& out) {
    std::size_t left = corners_.size();
    std::uint32_t at = 0;
    std::size_t refused = 0;
    bool forced = false;
    while (left >= 3) {
        if (tests_ > kMaxTests) return false;
        const Corner corner = corners_[at];
        if (left > 3 && refused < left && !is_ear(at)) {
            ++refused;
            at = corner.after;
            continue;
        }
        if (refused >= left) {
            // No ear is left: the rest is straight or intersects itself. Cut a corner that turns left, if
            // there is one.
            forced = true;
            for (std::size_t i = 0; i < left; ++i, at = corners_[at].after) {
                ++tests_;
                if (turn(corners_[corners_[at].before], corners_[at], corners_[corners_[at].after]) > flat_) {
                    break;
                }
            }
        }
        const Corner cut = corners_[at];
        out.push_back({corners_[cut.before].index, cut.index, corners_[cut.after].index});
        corners_[cut.before].after = cut.after;
        corners_[cut.after].before = cut.before;
        at = corners_[cut.after].after;  // not the neighbour, whose triangle would be a sliver
        refused = 0;
        --left;
    }
    crossing_ += forced;
    return true;
}

bool PolygonTriangulator::append(std::span<const std::uint32_t> corners, std::span<const Vec3> points,
                                 std::vector<Triangle>& out) {
    if (corners.size() == 3) {
        out.push_back({corners[0], corners[1], corners[2]});
        return true;
    }
    project(corners, points);
    if (!fan_fits()) return clip_ears(out);
    for (std::size_t i = 2; i < corners_.size(); ++i) {
        out.push_back({corners_[0].index, corners_[i - 1].index, corners_[i].index});
    }
    return true;
}

}  // namespace tribo::readers
