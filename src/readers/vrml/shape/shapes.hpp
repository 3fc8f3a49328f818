// SPDX-License-Identifier: MIT
// Triangles of the geometry that VRML describes by a few numbers. Shapes that are meant to be closed share
// their corners, so that volumes are right.
#pragma once

#include "readers/vrml/shape/surface.hpp"

namespace tribo::readers {

// Box, Cone, Cylinder, Sphere.
std::uint64_t count_solid_triangles(VrmlRole role);
Result<VrmlSurface> read_vrml_solid(const VrmlTree& tree, VrmlNodeId solid);

// Each square of an ElevationGrid is split from its corner at x + 1 to its corner at z + 1. The standard
// leaves this open; Coin splits in the same way.
std::uint64_t count_grid_triangles(const VrmlTree& tree, VrmlNodeId grid);
Result<VrmlSurface> read_vrml_grid(VrmlTree& tree, VrmlNodeId grid);

std::uint64_t count_extrusion_triangles(const VrmlTree& tree, VrmlNodeId extrusion);
Result<VrmlSurface> read_vrml_extrusion(const VrmlTree& tree, VrmlNodeId extrusion,
                                        PolygonTriangulator& triangulator);

}  // namespace tribo::readers
