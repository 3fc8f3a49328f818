// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "field/mesh/sheet_wall.hpp"

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
    SheetWall wall = wall_of_sheet(distance_.mesh(), distance_.normals(), thickness_);
    off_ = std::move(wall.off);
    wall_tree_.emplace(wall.mesh);
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
