// SPDX-License-Identifier: MIT
// Vertices on the faces between cells. They are needed where the line from a cell's vertex to the next one
// does not pass through their common face, and where the surface passes more than once through a face or
// through one of the cells beside it.
#pragma once

#include "field/contour/contour_table.hpp"

namespace tribo::field {

// Returns the vertices on the lower faces of the cells of one brick.
std::vector<SurfaceTable::FaceVertex> find_face_vertices(const SurfaceTable& table,
                                                         const BrickSurface& surface);

}  // namespace tribo::field
