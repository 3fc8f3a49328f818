// SPDX-License-Identifier: MIT
// Makes a mesh of the surface follow it between the vertices, too.
#pragma once

#include <cstdint>
#include <vector>

#include "base/mesh.hpp"
#include "base/parallel.hpp"
#include "field/carved/carved_field.hpp"

namespace tribo::field {

// Splits each edge of a mesh of the field (contour.hpp) whose middle is farther than `sagitta_mm` from the
// surface, or from the edge of the surface that it lies on. The new vertex is on the surface. The mesh stays
// closed. Needs time only where the surface bends over a cell: a mesh of a fine grid does not change. Does
// not depend on `parallel`. Drops the normals. Returns the vertices, sorted, at which the mesh may still
// leave the surface: its cells are crowded there (contour_mend.hpp).
std::vector<std::uint32_t> refine(TriangleMesh& mesh, const CarvedField& field, double sagitta_mm,
                                  const ParallelFor& parallel = serial_for);

// The mesh of the field for files and reports: contour(), refined and mended to 0.01 mm.
TriangleMesh fine_contour(const CarvedField& field, const ParallelFor& parallel = serial_for);

}  // namespace tribo::field
