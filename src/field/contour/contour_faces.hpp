// SPDX-License-Identifier: MIT
// Vertices on the faces between cells: where the way from one cell's vertex to the next one's does not pass
// through their face, and where the surface passes a face, or one of the cells beside it, more than once.
#pragma once

#include "field/contour/contour_table.hpp"

namespace tribo::field {

// Of the lower faces of the cells of one brick.
std::vector<SurfaceTable::FaceVertex> find_face_vertices(const SurfaceTable& table,
                                                         const BrickSurface& surface);

}  // namespace tribo::field
