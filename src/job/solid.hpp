// SPDX-License-Identifier: MIT
// A blank or a fixture: an axis-aligned box, or what a closed mesh encloses, and the shapes for the field
// that are made from it.
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
    Box3 box_mm;                           // empty where it is a mesh
    std::optional<field::MeshShape> mesh;  // absent where it is a box
    double volume_mm3 = 0;
    std::uint64_t hash = 0;  // of the box or of the mesh
};

Solid box_solid(const Box3& box_mm);
// Refuses what field::MeshShape refuses, in the name of the file.
Result<Solid> mesh_solid(TriangleMesh mesh, const std::string& file);

// The solid in the coordinates of a frame that stands in the solid's own. A box stays a box where the frame's
// axes run along those of the box.
std::unique_ptr<const field::Shape> shape_of(const Solid& solid, const motion::WorkFrame& frame = {});

}  // namespace tribo::job
