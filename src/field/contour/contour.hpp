// SPDX-License-Identifier: MIT
// From the field to triangles: dual contouring (Ju, Losasso, Schaefer & Warren 2002) on the exact level, so
// that cusps and corners are as sharp as the sweeps that made them.
#pragma once

#include "base/mesh.hpp"
#include "base/parallel.hpp"
#include "field/carved/carved_field.hpp"

namespace tribo::field {

struct ContourOptions {
    // Bricks whose surface is one plane to this angle (rad) and distance (in cells) become a single vertex:
    // large flats cost few triangles, without cracks towards their finer neighbours.
    double flat_angle_rad = 1e-5;
    double flat_cells = 1e-4;
};

// The closed surface of the material that is left, vertices within rounding of the exact surface except where
// a cusp is thinner than a cell. Every directed edge is matched by an opposite one. The same mesh whatever
// `parallel` does.
TriangleMesh contour(const CarvedField& field, const ParallelFor& parallel = serial_for,
                     const ContourOptions& options = {});

// The part of that surface that belongs to the bricks from `first` on up to `last`, which is left out, in
// each coordinate: parts that share no brick and leave out none are the whole, with the vertices on their
// borders in both. For a picture that follows the cut, part by part.
TriangleMesh contour_part(const CarvedField& field, BrickCoord first, BrickCoord last,
                          const ContourOptions& options = {});

}  // namespace tribo::field
