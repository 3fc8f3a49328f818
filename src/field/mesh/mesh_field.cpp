// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_field.hpp"

#include <algorithm>
#include <utility>

#include "field/mesh/mesh_parts.hpp"
#include "field/mesh/mesh_surfaces.hpp"

namespace tribo::field {
namespace {

// 0 inside.
double way_to(const Box3& box, Vec3 p) {
    const Vec3 off{std::max({box.min.x - p.x, p.x - box.max.x, 0.0}),
                   std::max({box.min.y - p.y, p.y - box.max.y, 0.0}),
                   std::max({box.min.z - p.z, p.z - box.max.z, 0.0})};
    return length(off);
}

}  // namespace

Result<std::unique_ptr<MeshField>> MeshField::make(TriangleMesh mesh, double thickness_mm) {
    weld_exactly(mesh);
    std::erase_if(mesh.triangles, is_degenerate);
    if (!(area_mm2(mesh) > 0)) return fail("the model has no surface", "check that it holds triangles");
    const bool two_sided = drop_twins(mesh);
    part_at_crowded_edges(mesh);
    const MeshNormals normals(mesh);
    std::vector<MeshBody> bodies;
    double skin = 0;
    if (two_sided || normals.turned_edges() > 0) {
        const Box3 box = bounds(mesh);
        skin = std::min(thickness_mm, kSkinOfDiagonal * distance(box.min, box.max));
        bodies.emplace_back(std::move(mesh), 0, skin);
    } else {
        if (normals.border_edges() == 0 && volume_mm3(mesh) < 0) {
            for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
        }
        for (MeshPart& part : parts_of(std::move(mesh), thickness_mm))
            bodies.emplace_back(std::move(part.mesh), part.is_closed ? 0 : thickness_mm, 0);
    }
    return std::unique_ptr<MeshField>(new MeshField(std::move(bodies), skin, two_sided));
}

contact::SurfaceSample MeshField::sample(Vec3 p) const {
    contact::SurfaceSample nearest = bodies_[0].sample(p);
    for (std::size_t n = 1; n < bodies_.size(); ++n) {
        const double way = way_to(bodies_[n].box_mm(), p);
        if (way > 0 && way >= nearest.distance_mm) continue;
        contact::SurfaceSample one = bodies_[n].sample(p);
        if (one.distance_mm >= nearest.distance_mm) continue;
        one.piece = static_cast<std::uint32_t>(n);
        nearest = one;
    }
    return nearest;
}

Box3 MeshField::bounds_mm() const {
    Box3 box = bodies_[0].bounds_mm();
    for (const MeshBody& body : bodies_) box.include(body.bounds_mm());
    return box;
}

bool MeshField::is_sheet() const {
    return std::ranges::any_of(bodies_, &MeshBody::is_sheet);
}

bool MeshField::is_solid() const {
    return skin_ == 0 && std::ranges::any_of(bodies_, [](const MeshBody& body) { return !body.is_sheet(); });
}

}  // namespace tribo::field
