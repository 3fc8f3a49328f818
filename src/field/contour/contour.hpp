// SPDX-License-Identifier: MIT
// Computes triangles from the field: dual contouring (Ju, Losasso, Schaefer & Warren 2002) on the exact
// level. Cusps and corners are therefore as sharp as the sweeps that made them.
#pragma once

#include "base/mesh.hpp"
#include "base/parallel.hpp"
#include "field/carved/carved_field.hpp"

namespace tribo::field {

struct ContourOptions {
    // A brick becomes a single vertex if its surface is one plane within this angle (rad) and distance (in
    // cells). Large flats then need few triangles, without cracks towards their finer neighbours.
    double flat_angle_rad = 1e-5;
    double flat_cells = 1e-4;
    // From the distances at the nodes alone, for a picture that has to be there at once: a fifth of the time.
    // The surface is off by up to the sagitta of a cell, a cusp by up to half a cell, and walls and slits
    // thinner than a cell are missing.
    bool rough = false;
};

// Returns the closed surface of the remaining material. Its vertices are within rounding of the exact
// surface, except where a cusp is thinner than a cell. Every directed edge has a matching opposite edge. The
// mesh does not depend on `parallel`.
TriangleMesh contour(const CarvedField& field, const ParallelFor& parallel = serial_for,
                     const ContourOptions& options = {});

// Returns the part of that surface that belongs to the bricks from `first` up to `last` (excluded) in each
// coordinate. Parts that cover all bricks once form the whole surface; the vertices on their borders are in
// both parts. For a picture that is updated part by part during the cut.
TriangleMesh contour_part(const CarvedField& field, BrickCoord first, BrickCoord last,
                          const ContourOptions& options = {});

}  // namespace tribo::field
