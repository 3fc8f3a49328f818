// SPDX-License-Identifier: MIT
#include "field/mesh/sheet_wall.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <tuple>

#include "base/math.hpp"

namespace tribo::field {

SheetWall wall_of_sheet(const TriangleMesh& mesh, const MeshNormals& normals, double thickness_mm) {
    constexpr TrianglePlace kEdges[] = {TrianglePlace::edge0, TrianglePlace::edge1, TrianglePlace::edge2},
                            kCorners[] = {TrianglePlace::corner0, TrianglePlace::corner1,
                                          TrianglePlace::corner2};
    // Triangles in place of the arc of a sector are off by so much at most, mm.
    constexpr double kSagitta = 1e-5;
    constexpr int kMostParts = 64;
    SheetWall wall;
    const auto add = [&](std::initializer_list<Vec3> corners, Vec3 off) {
        const auto first = static_cast<std::uint32_t>(wall.mesh.positions.size());
        for (const Vec3 p : corners) wall.mesh.positions.push_back(to_float(p));
        for (std::uint32_t n = 2; n < corners.size(); ++n) {
            wall.mesh.triangles.push_back({first, first + n - 1, first + n});
            wall.off.push_back(off);
        }
    };
    const auto behind = [&](std::uint32_t triangle) {
        return -thickness_mm * normals.at(mesh, triangle, TrianglePlace::face);
    };
    struct Side {
        std::uint32_t low, high, triangle;
        std::size_t edge;
    };
    std::vector<Side> inner;
    for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
        for (std::size_t e = 0; e < 3; ++e) {
            const std::uint32_t from = mesh.triangles[n][e], to = mesh.triangles[n][(e + 1) % 3];
            if (!normals.is_border(mesh, n, kEdges[e])) {
                inner.push_back({std::min(from, to), std::max(from, to), n, e});
                continue;
            }
            const Vec3 a = mesh.position(from), b = mesh.position(to), down = behind(n);
            add({a, b, b + down, a + down}, normalized(cross(down, b - a), {1, 0, 0}));
        }
    }
    std::ranges::sort(inner, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.triangle); });
    for (std::size_t n = 1; n < inner.size(); ++n) {
        const Side &one = inner[n - 1], &other = inner[n];
        if (one.low != other.low || one.high != other.high) continue;
        const Vec3 first = behind(one.triangle), last = behind(other.triangle);
        const double angle = math::atan2(length(cross(first, last)), dot(first, last));
        const int parts = std::clamp(
            static_cast<int>(std::ceil(angle / std::sqrt(8 * kSagitta / thickness_mm))), 1, kMostParts);
        for (const std::size_t end : {one.edge, (one.edge + 1) % 3}) {
            if (!normals.is_border(mesh, one.triangle, kCorners[end])) continue;
            const std::uint32_t corner = mesh.triangles[one.triangle][end];
            const Vec3 at = mesh.position(corner),
                       inward = mesh.position(corner == one.low ? one.high : one.low) - at;
            const auto on_arc = [&](int k) {
                return at +
                       thickness_mm * normalized(lerp(first, last, static_cast<double>(k) / parts), first);
            };
            for (int k = 0; k < parts; ++k)
                add({at, on_arc(k), on_arc(k + 1)}, normalized(-1 * inward, {1, 0, 0}));
        }
    }
    return wall;
}

}  // namespace tribo::field
