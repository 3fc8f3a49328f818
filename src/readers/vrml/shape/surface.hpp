// SPDX-License-Identifier: MIT
// The triangles of one geometry node, in its own frame.
#pragma once

#include "base/mesh.hpp"
#include "readers/mesh/model.hpp"
#include "readers/mesh/model_polygon.hpp"
#include "readers/vrml/tree.hpp"

namespace tribo::readers {

// Number of flat sides of Cone, Cylinder and Sphere around the y axis; a sphere has half as many from pole to
// pole. Corners are on the true surface, so sides are up to 0.12 % of the radius inside.
inline constexpr std::uint32_t kVrmlSides = 64;

struct VrmlSurface {
    std::vector<Vec3> points;         // used points only, so that only they are transformed
    std::vector<Triangle> triangles;  // counter-clockwise seen from outside
    std::vector<Rgb8> colours;        // one per triangle, or empty
    double crease_angle_rad = 0;
    bool solid = true;
};

// Returns an upper limit of the triangles of the node, from its lists alone.
std::uint64_t count_triangles(const VrmlTree& tree, VrmlNodeId geometry);

// Reads any node whose role is_surface(). Allocates in proportion to the triangles, not to the points of a
// Coordinate shared by many face sets. Harmless errors are added to tree.warnings.
Result<VrmlSurface> read_vrml_surface(VrmlTree& tree, VrmlNodeId geometry, PolygonTriangulator& triangulator);

// Returns the colours of a Color node, or the one of a Material; empty if there is none.
std::vector<Rgb8> read_vrml_colours(const VrmlTree& tree, VrmlNodeId node, std::string_view field);

}  // namespace tribo::readers
