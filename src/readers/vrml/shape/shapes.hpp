// SPDX-License-Identifier: MIT
// Geometry that VRML describes by a few numbers, as triangles: closed where it is meant to be, so that
// corners are shared and volumes come out right.
#pragma once

#include "readers/vrml/shape/surface.hpp"

namespace tribo::readers {

// Box, Cone, Cylinder, Sphere.
std::uint64_t count_solid_triangles(VrmlRole role);
Result<VrmlSurface> read_vrml_solid(const VrmlTree& tree, VrmlNodeId solid);

// Each square of an ElevationGrid is cut from its corner at x + 1 to that at z + 1, which the standard leaves
// open; Coin cuts the same way.
std::uint64_t count_grid_triangles(const VrmlTree& tree, VrmlNodeId grid);
Result<VrmlSurface> read_vrml_grid(VrmlTree& tree, VrmlNodeId grid);

std::uint64_t count_extrusion_triangles(const VrmlTree& tree, VrmlNodeId extrusion);
Result<VrmlSurface> read_vrml_extrusion(const VrmlTree& tree, VrmlNodeId extrusion,
                                        PolygonTriangulator& triangulator);

}  // namespace tribo::readers
