// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_distance.hpp"

#include <utility>

namespace tribo::field {

MeshDistance::MeshDistance(TriangleMesh mesh, bool is_solid)
    : mesh_(std::move(mesh)), tree_(mesh_), normals_(mesh_) {
    if (is_solid) outside_ = MeshOutside::of(mesh_, tree_);
}

MeshPoint MeshDistance::describe(Vec3 point_mm, const MeshTree::Nearest& nearest) const {
    const TrianglePoint& at = nearest.at;
    MeshPoint found{at.point_mm, normals_.at(mesh_, nearest.triangle, at.place), std::sqrt(at.squared_mm2),
                    nearest.triangle, normals_.is_border(mesh_, nearest.triangle, at.place)};
    if (dot(point_mm - at.point_mm, found.normal) < 0) found.distance_mm = -found.distance_mm;
    return outside_ ? describe_outside(point_mm, found, at.place) : found;
}

// The nearest place of all triangles is on the outside if the point is in air.
MeshPoint MeshDistance::describe_outside(Vec3 point_mm, MeshPoint found, TrianglePlace place_on) const {
    const MeshOutside::Side side = outside_->side(found.triangle, place_on);
    if (side == MeshOutside::Side::front) return found;
    if (side == MeshOutside::Side::back) {
        found.distance_mm = -found.distance_mm;
        found.normal = -found.normal;
        return found;
    }
    if (winding(point_mm) == 0) {
        found.distance_mm = std::abs(found.distance_mm);
        found.normal = normalized(point_mm - found.point_mm, found.normal);
        return found;
    }
    const MeshOutside::Place place = outside_->nearest(mesh_, tree_, point_mm);
    return {place.nearest.at.point_mm, place.normal, -std::sqrt(place.nearest.at.squared_mm2),
            place.nearest.triangle, false};
}

}  // namespace tribo::field
