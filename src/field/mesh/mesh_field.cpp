// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_field.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <tuple>
#include <utility>

#include "base/math.hpp"

namespace tribo::field {
namespace {

// Nearer to the mesh than this, the direction to it is rounding noise, mm.
constexpr double kOnSurface = 1e-6;

contact::SurfaceSample towards(Vec3 way, Vec3 otherwise) {
    const double d = length(way);
    return {d, d > kOnSurface ? way / d : otherwise, 0};
}

}  // namespace

Result<std::unique_ptr<MeshField>> MeshField::make(TriangleMesh mesh, double thickness_mm) {
    weld_exactly(mesh);
    std::erase_if(mesh.triangles, is_degenerate);
    if (!(area_mm2(mesh) > 0)) return fail("the model has no surface", "check that it holds triangles");
    const MeshNormals normals(mesh);
    if (normals.turned_edges() > 0) {
        const Box3 box = bounds(mesh);
        const double skin = std::min(thickness_mm, kSkinOfDiagonal * distance(box.min, box.max));
        return std::unique_ptr<MeshField>(new MeshField(std::move(mesh), 0, skin));
    }
    const bool closed = normals.border_edges() == 0;
    if (closed && volume_mm3(mesh) < 0) {
        for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    }
    return std::unique_ptr<MeshField>(new MeshField(std::move(mesh), closed ? 0 : thickness_mm, 0));
}

MeshField::MeshField(TriangleMesh mesh, double thickness_mm, double skin_mm)
    : distance_(std::move(mesh)), thickness_(thickness_mm), skin_(skin_mm) {
    if (!is_sheet()) return;
    Wall wall = wall_of(distance_.mesh(), distance_.normals(), thickness_);
    off_ = std::move(wall.off);
    wall_tree_.emplace(wall.mesh);
}

// Where the nearest place of the sheet comes to be on its border: behind each of the border's edges, and,
// where two faces meet there, the sector between the ways behind them.
MeshField::Wall MeshField::wall_of(const TriangleMesh& mesh, const MeshNormals& normals,
                                   double thickness_mm) {
    constexpr TrianglePlace kEdges[] = {TrianglePlace::edge0, TrianglePlace::edge1, TrianglePlace::edge2},
                            kCorners[] = {TrianglePlace::corner0, TrianglePlace::corner1,
                                          TrianglePlace::corner2};
    // Triangles in place of the arc of a sector are off by so much at most, mm.
    constexpr double kSagitta = 1e-5;
    constexpr int kMostParts = 64;
    Wall wall;
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

contact::SurfaceSample MeshField::sample(Vec3 p) const {
    const MeshPoint at = distance_.closest(p);
    const Vec3 way = p - at.point_mm;
    const double s = at.distance_mm;
    if (skin_ > 0) {
        contact::SurfaceSample skin = towards(way, at.normal);
        skin.distance_mm -= 0.5 * skin_;
        return skin;
    }
    const auto to_wall = [&] {
        const MeshTree::Nearest nearest = wall_tree_->nearest(p);
        return std::pair(p - nearest.at.point_mm, off_[nearest.triangle]);
    };
    if (at.on_border && is_sheet()) {
        const auto [beyond, off] = to_wall();
        return towards(beyond, off);
    }
    const Vec3 front = std::abs(s) > kOnSurface ? way / s : at.normal;
    if (!is_sheet() || s >= 0) return {s, front, 0};
    const auto [beyond, off] = to_wall();
    const double back = -s - thickness_, end = length(beyond);
    if (back > 0) return end < back ? towards(beyond, off) : contact::SurfaceSample{back, -front, 0};
    if (-end > std::max(s, back)) return {-end, end > kOnSurface ? -beyond / end : off, 0};
    return back > s ? contact::SurfaceSample{back, -front, 0} : contact::SurfaceSample{s, front, 0};
}

}  // namespace tribo::field
