// SPDX-License-Identifier: MIT
// A closed triangle mesh as a solid: a blank or a fixture that was read from a file. Copies share the mesh.
#pragma once

#include <memory>

#include "base/result.hpp"
#include "field/mesh/mesh_distance.hpp"
#include "field/shape/shape.hpp"

namespace tribo::field {

// distance_mm is the exact distance to the mesh, or to the outside of one that passes through itself.
class MeshShape final : public Shape {
  public:
    // Refuses a mesh that is not closed, that has turned-over triangles or that encloses nothing. If it is
    // not closed, equal positions are first made one vertex. Turns a mesh that is inside out.
    static Result<std::unique_ptr<MeshShape>> make(TriangleMesh mesh);

    Box3 bounds_mm() const override { return distance_->bounds_mm(); }
    double distance_mm(Vec3 point_mm) const override { return distance_->closest(point_mm).distance_mm; }
    Vec3 gradient(Vec3 point_mm) const override;
    void sample(const Lattice& lattice, float* out) const override;

    const TriangleMesh& mesh() const { return distance_->mesh(); }
    // Each place within the solid counts once.
    double volume_mm3() const { return distance_->volume_mm3(); }

  private:
    explicit MeshShape(TriangleMesh mesh)
        : distance_(std::make_shared<const MeshDistance>(MeshDistance::of_solid(std::move(mesh)))) {}

    std::shared_ptr<const MeshDistance> distance_;
};

}  // namespace tribo::field
