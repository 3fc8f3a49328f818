// SPDX-License-Identifier: MIT
// IndexedFaceSet to triangles (ISO/IEC 14772-1, 6.23).
#pragma once

#include "readers/vrml/shape/surface.hpp"

namespace tribo::readers {

std::uint64_t count_face_set_triangles(const VrmlTree& tree, VrmlNodeId face_set);
Result<VrmlSurface> read_vrml_face_set(VrmlTree& tree, VrmlNodeId face_set,
                                       PolygonTriangulator& triangulator);

}  // namespace tribo::readers
