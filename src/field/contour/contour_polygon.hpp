// SPDX-License-Identifier: MIT
// Divides the polygon around a crossed edge of the grid into triangles that meet no triangles of other
// polygons.
//
// The vertices of the four cells around an edge lie in their cells, and the line from one vertex to the next
// passes through the face between the two cells. The tetrahedra of the edge and two consecutive vertices then
// belong to this edge alone. A polygon that stays in them meets no other polygon (Ju and Udeshi 2006,
// "Intersection-free contouring on an octree grid").
#pragma once

#include <span>

#include "base/vec3.hpp"

namespace tribo::field {

// The corners of a polygon are given relative to the edge: x and y across it, z along it, from 0 at its lower
// to 1 at its upper end. Their order is counter-clockwise around the edge.
//
// Returns the corner, 0 or 1, from which a diagonal makes two triangles that stay in the tetrahedra. If both
// do, returns the one that meets the edge closer to `along`; 0 if they are equally close. Returns -1 if none
// does; triangles from the crossing itself to each side always stay in them. The triangles keep the distance
// `margin` from the ends of the edge.
int diagonal_from(std::span<const Vec3, 4> corners, double along, double margin);
// Returns true if one triangle stays in the tetrahedra.
bool triangle_stays(std::span<const Vec3, 3> corners, double margin);

}  // namespace tribo::field
