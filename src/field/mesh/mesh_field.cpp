// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
    border_ = border_of(distance_.mesh(), distance_.normals());
    border_tree_.emplace(border_.edges);
}

MeshField::Border MeshField::border_of(const TriangleMesh& mesh, const MeshNormals& normals) {
    constexpr TrianglePlace kEdges[] = {TrianglePlace::edge0, TrianglePlace::edge1, TrianglePlace::edge2};
    Border border;
    border.edges.positions = mesh.positions;
    for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
        for (std::size_t e = 0; e < 3; ++e) {
            if (!normals.is_border(mesh, n, kEdges[e])) continue;
            const std::uint32_t from = mesh.triangles[n][e], to = mesh.triangles[n][(e + 1) % 3];
            border.edges.triangles.push_back({from, to, to});
            const Vec3 along = mesh.position(to) - mesh.position(from);
            border.off.push_back(
                normalized(cross(along, normals.at(mesh, n, TrianglePlace::face)), {1, 0, 0}));
        }
    }
    return border;
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
    if (at.on_border && is_sheet()) {
        // Beyond the border: the wall there, from the edge of the front to the edge of the back.
        const double up = dot(way, at.normal);
        if (up > 0) return towards(way, at.normal);
        const Vec3 off = border_.off[border_tree_->nearest(p).triangle], aside = way - up * at.normal;
        return towards(up < -thickness_ ? aside + (up + thickness_) * at.normal : aside, off);
    }
    const Vec3 front = std::abs(s) > kOnSurface ? way / s : at.normal;
    contact::SurfaceSample found{s, front, 0};
    if (!is_sheet() || s >= 0) return found;
    if (-s - thickness_ > s) found = {-s - thickness_, -front, 0};
    if (found.distance_mm > 0) return found;
    const MeshTree::Nearest edge = border_tree_->nearest(p);
    const Vec3 off = border_.off[edge.triangle];
    const double wall = dot(p - edge.at.point_mm, off);
    if (wall > found.distance_mm && wall <= 0) found = {wall, off, 0};
    return found;
}

}  // namespace tribo::field
