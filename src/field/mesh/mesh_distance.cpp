// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_distance.hpp"

#include <utility>

namespace tribo::field {

MeshDistance::MeshDistance(TriangleMesh mesh) : mesh_(std::move(mesh)), tree_(mesh_), normals_(mesh_) {}

MeshPoint MeshDistance::describe(Vec3 point_mm, const MeshTree::Nearest& nearest) const {
    const TrianglePoint& at = nearest.at;
    MeshPoint found{at.point_mm, normals_.at(mesh_, nearest.triangle, at.place), std::sqrt(at.squared_mm2),
                    nearest.triangle, normals_.is_border(mesh_, nearest.triangle, at.place)};
    if (dot(point_mm - at.point_mm, found.normal) < 0) found.distance_mm = -found.distance_mm;
    return found;
}

}  // namespace tribo::field
