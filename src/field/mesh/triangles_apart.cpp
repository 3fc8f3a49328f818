// SPDX-License-Identifier: MIT
#include "field/mesh/triangles_apart.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tribo::field {
namespace {

// The gap that a plane must leave, mm: far more than rounding.
constexpr double kGapMm = 1e-7;
// Unit vectors within this of a plane (sine) lie in it; those beyond the second value surely do not.
constexpr double kIn = 1e-12, kOff = 1e-6;
// Edges with a smaller squared sine of their angle give no plane.
constexpr double kParallel = 1e-12;
// Two triangles at an edge are folded if the cosine of their angle is larger.
constexpr double kFolded = 1 - 1e-4;

struct Range {
    double least, most;
};

template <class Points>
Range range_along(Vec3 across, const Points& points) {
    Range r{dot(across, points[0]), dot(across, points[0])};
    for (const Vec3& p : points) {
        r.least = std::min(r.least, dot(across, p));
        r.most = std::max(r.most, dot(across, p));
    }
    return r;
}

bool plane_parts(Vec3 across, const Corners& a, const Corners& b) {
    const double gap = kGapMm * length(across);
    if (!(gap > 0)) return false;
    const Range of_a = range_along(across, a), of_b = range_along(across, b);
    return of_a.most + gap < of_b.least || of_b.most + gap < of_a.least;
}

// Of triangles without a common vertex: the planes of the separating axis theorem, those for triangles in one
// plane too.
bool are_parted(const Corners& a, const Corners& b) {
    const Corners edges_a{a[1] - a[0], a[2] - a[1], a[0] - a[2]};
    const Corners edges_b{b[1] - b[0], b[2] - b[1], b[0] - b[2]};
    const Vec3 normal_a = cross(edges_a[0], edges_a[1]), normal_b = cross(edges_b[0], edges_b[1]);
    if (plane_parts(normal_a, a, b) || plane_parts(normal_b, a, b)) return true;
    for (const Vec3& s : edges_a) {
        for (const Vec3& t : edges_b) {
            const Vec3 across = cross(s, t);
            if (squared_length(across) > kParallel * squared_length(s) * squared_length(t) &&
                plane_parts(across, a, b))
                return true;
        }
    }
    const auto beside = [&](Vec3 normal, const Corners& edges) {
        return std::any_of(edges.begin(), edges.end(),
                           [&](const Vec3& edge) { return plane_parts(cross(normal, edge), a, b); });
    };
    return beside(normal_a, edges_a) || beside(normal_b, edges_b);
}

// The two unit vectors from a common vertex along the edges of a triangle.
using Sector = std::array<Vec3, 2>;

// A plane through the common vertex: one sector lies beyond it, the other one does not cross it.
bool plane_parts_sectors(Vec3 across, const Sector& a, const Sector& b) {
    across = normalized(across, {});
    const Range of_a = range_along(across, a), of_b = range_along(across, b);
    const auto parts = [](double low, double high) {
        return (low < -kOff && high > -kIn) || (low < kIn && high > kOff);
    };
    return parts(of_a.most, of_b.least) || parts(of_b.most, of_a.least);
}

bool sectors_are_parted(const Sector& a, const Sector& b) {
    const Vec3 normal_a = cross(a[0], a[1]), normal_b = cross(b[0], b[1]);
    if (plane_parts_sectors(normal_a, a, b) || plane_parts_sectors(normal_b, a, b) ||
        plane_parts_sectors(a[0] + a[1] - b[0] - b[1], a, b))
        return true;
    for (std::size_t i = 0; i < 2; ++i) {
        if (plane_parts_sectors(cross(normal_a, a[i]), a, b) ||
            plane_parts_sectors(cross(normal_b, b[i]), a, b))
            return true;
        // Through an edge of each: the other edges lie on its two sides.
        for (std::size_t j = 0; j < 2; ++j) {
            const Vec3 across = cross(a[i], b[j]);
            const double size = length(across);
            if (!(size * size > kParallel)) continue;
            const double by_a = dot(across, a[1 - i]), by_b = dot(across, b[1 - j]), off = kOff * size;
            if ((by_a > off && by_b < -off) || (by_a < -off && by_b > off)) return true;
        }
    }
    return false;
}

Sector sector(const Corners& c, std::size_t from) {
    return {normalized(c[(from + 1) % 3] - c[from], {}), normalized(c[(from + 2) % 3] - c[from], {})};
}

// From an edge to a point beside it, across the edge.
Vec3 from_edge(Vec3 p, Vec3 on_edge, Vec3 along) {
    const Vec3 way = p - on_edge;
    return way - dot(way, along) * along;
}

bool are_folded(Vec3 from_edge_a, Vec3 from_edge_b) {
    const double a = length(from_edge_a), b = length(from_edge_b);
    return !(a > kGapMm && b > kGapMm && dot(from_edge_a, from_edge_b) < kFolded * a * b);
}

}  // namespace

bool surely_apart(const Facet& a, const Facet& b) {
    std::array<std::pair<std::size_t, std::size_t>, 9> shared;
    std::size_t count = 0;
    if (twice_area(a.at) == Vec3{} || twice_area(b.at) == Vec3{}) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (a.vertices[i] == b.vertices[j]) shared[count++] = {i, j};
        }
    }
    if (count == 0) return are_parted(a.at, b.at);
    const auto [i, j] = shared[0];
    if (count == 1) return sectors_are_parted(sector(a.at, i), sector(b.at, j));
    if (count > 2) return false;
    const auto [k, l] = shared[1];
    const Vec3 along = normalized(a.at[k] - a.at[i], {});
    return !are_folded(from_edge(a.at[3 - i - k], a.at[i], along),
                       from_edge(b.at[3 - j - l], a.at[i], along));
}

}  // namespace tribo::field
