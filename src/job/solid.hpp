// SPDX-License-Identifier: MIT
// A blank or a fixture: an axis-aligned box or the inside of a closed mesh, and its shape for the
// distance field.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/mesh.hpp"
#include "base/result.hpp"
#include "field/mesh/mesh_shape.hpp"
#include "motion/machine/work_frame.hpp"

namespace tribo::job {

// Copies share the mesh.
struct Solid {
    Box3 box_mm;                           // empty for a mesh
    std::optional<field::MeshShape> mesh;  // absent for a box
    double volume_mm3 = 0;
    double thickness_mm = 0;  // mean: twice the volume over the area of the surface; of a sheet its thickness
    std::uint64_t hash = 0;   // of the box or of the mesh
};

// Refuse coordinates and edges of a box that are out of range (base/limits.hpp). The error has no place.
Result<void> check_place(const Box3& box_mm);
Result<void> check_edges(Vec3 size_mm);
// Both.
Result<void> check_room(const Box3& box_mm);

Solid box_solid(const Box3& box_mm);
// Refuses meshes that field::MeshShape refuses. The error names the file.
Result<Solid> mesh_solid(TriangleMesh mesh, const std::string& file);

// The solid in the coordinates of a frame. `frame` is given in the coordinates of the solid. A box stays a
// box if the axes are parallel.
std::unique_ptr<const field::Shape> shape_of(const Solid& solid, const motion::WorkFrame& frame = {});

}  // namespace tribo::job
