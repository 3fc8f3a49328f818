// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "field/mesh/sheet_wall.hpp"

namespace tribo::field {
namespace {

// Nearer to the mesh than this, the direction to it is rounding noise, mm.
constexpr double kOnSurface = 1e-6;
// Normals that differ by less are of one side.
constexpr double kAlike = 1e-3;

contact::SurfaceSample towards(Vec3 way, Vec3 otherwise) {
    const double d = length(way);
    return {d, d > kOnSurface ? way / d : otherwise, 0};
}

}  // namespace

MeshBody::MeshBody(TriangleMesh mesh, double thickness_mm, double skin_mm)
    : distance_(thickness_mm > 0 || skin_mm > 0 ? MeshDistance(std::move(mesh))
                                                : MeshDistance::of_solid(std::move(mesh))),
      thickness_(thickness_mm),
      skin_(skin_mm),
      box_(distance_.bounds_mm().inflated(thickness_mm + 0.5 * skin_mm)) {
    if (!is_sheet()) return;
    SheetWall wall = wall_of_sheet(distance_.mesh(), distance_.normals(), thickness_);
    off_ = std::move(wall.off);
    wall_tree_.emplace(wall.mesh);
}

// The normal at a place where the point itself tells no direction. At the bottom of a groove the surface has
// two, and the mean of them is none: it is the one that is nearer from a little in front.
Vec3 MeshBody::normal_on(const MeshPoint& at) const {
    constexpr double kInFront = 1e-4;  // mm
    const Vec3 face = distance_.normals().at(distance_.mesh(), at.triangle, TrianglePlace::face);
    if (squared_length(at.normal - face) < kAlike * kAlike ||
        squared_length(at.normal + face) < kAlike * kAlike)
        return at.normal;
    const Vec3 in_front = at.point_mm + kInFront * at.normal;
    return normalized(in_front - distance_.closest(in_front).point_mm, at.normal);
}

contact::SurfaceSample MeshBody::sample(Vec3 p) const {
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
    const Vec3 front = std::abs(s) > kOnSurface ? way / s : normal_on(at);
    if (!is_sheet() || s >= 0) return {s, front, 0};
    const auto [beyond, off] = to_wall();
    const double back = -s - thickness_, end = length(beyond);
    if (back > 0) return end < back ? towards(beyond, off) : contact::SurfaceSample{back, -front, 0};
    if (-end > std::max(s, back)) return {-end, end > kOnSurface ? -beyond / end : off, 0};
    return back > s ? contact::SurfaceSample{back, -front, 0} : contact::SurfaceSample{s, front, 0};
}

}  // namespace tribo::field
