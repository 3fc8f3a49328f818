// SPDX-License-Identifier: MIT
// How the polygon around a crossed edge of the grid becomes triangles that meet no other polygon's.
//
// Vertices of the four cells around an edge lie in their cells, and the way from one to the next passes
// through the face between the two cells. The tetrahedra of the edge and two vertices that follow each other
// then belong to this edge alone, and a polygon that stays in them meets no other (Ju and Udeshi 2006,
// "Intersection-free contouring on an octree grid").
#pragma once

#include <span>

#include "base/vec3.hpp"

namespace tribo::field {

// Corners of such a polygon seen from the edge: x and y across it, z along it, from 0 at its lower to 1 at
// its upper end, in the order in which they go around it, counter-clockwise.
//
// The corner, 0 or 1, from which a diagonal makes two triangles that stay in the tetrahedra; of two such the
// one that meets the edge closer to `along`, of equally close ones 0. -1: none does, triangles from the
// crossing itself to each side always do. Ends of the edge are avoided by `margin`.
int diagonal_from(std::span<const Vec3, 4> corners, double along, double margin);
// Whether one triangle does.
bool triangle_stays(std::span<const Vec3, 3> corners, double margin);

}  // namespace tribo::field
