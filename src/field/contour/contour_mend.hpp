// SPDX-License-Identifier: MIT
// Mends a mesh of the surface where cells were too crowded for it.
#pragma once

#include <cstdint>
#include <span>

#include "base/mesh.hpp"
#include "base/parallel.hpp"
#include "field/carved/carved_field.hpp"

namespace tribo::field {

// A cell of the grid has a vertex for each piece of the surface, inside the cell. A cusp that ends beyond the
// cell without an edge of the grid in it, or two edges of the surface in one cell, ask for more. Around the
// given vertices: vertices off the surface are moved onto it or taken out, edges and triangles that leave it
// by more than `off_mm` are flipped, or get a vertex on it. What would let the mesh meet itself is not done,
// so the mesh stays closed and free of intersections; some places may stay as they are. At most about 2 s,
// and 1 us more for each triangle, of one processor: then the rest stays as it is. The vertices are numbered
// anew. Needs a mesh without normals. Works on blocks of some cells at once; does not depend on `parallel`.
void mend(TriangleMesh& mesh, const CarvedField& field, double off_mm,
          std::span<const std::uint32_t> vertices, const ParallelFor& parallel = serial_for);

}  // namespace tribo::field
