// SPDX-License-Identifier: MIT
// A blank or a fixture as a shape for the field: an axis-aligned box, or what a closed mesh encloses.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/mesh.hpp"
#include "base/result.hpp"
#include "field/shape/shape.hpp"
#include "motion/machine/work_frame.hpp"

namespace tribo::job {

struct Solid {
    std::unique_ptr<const field::Shape> shape;
    double volume_mm3 = 0;
    std::uint64_t hash = 0;              // of the box or of the mesh
    Box3 box_mm;                         // empty where it is a mesh
    const TriangleMesh* mesh = nullptr;  // the shape's own; null where it is a box
};

Solid box_solid(const Box3& box_mm);
// Refuses what field::MeshShape refuses, in the name of the file.
Result<Solid> mesh_solid(TriangleMesh mesh, const std::string& file);

// The solid in the coordinates of a frame that stands in the solid's own. A box stays a box where the frame's
// axes run along those of the box.
std::unique_ptr<const field::Shape> in_frame(Solid solid, const motion::WorkFrame& frame);

}  // namespace tribo::job
