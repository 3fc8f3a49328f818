// SPDX-License-Identifier: MIT
// Whether two triangles of a mesh surely meet nowhere but at the vertices that they share.
#pragma once

#include <array>

#include "base/mesh.hpp"

namespace tribo::field {

using Corners = std::array<Vec3, 3>;

inline Corners corners(const TriangleMesh& mesh, const Triangle& t) {
    return {mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2])};
}

// Twice the area, along the normal.
inline Vec3 twice_area(const Corners& c) {
    return cross(c[1] - c[0], c[2] - c[0]);
}

// A triangle with the places of its vertices, mm.
struct Facet {
    Triangle vertices;
    Corners at;
};

// True only if a plane proves it: between the triangles, or through a shared vertex. Two that share an edge
// must not be folded onto each other (less than a degree). False where rounding could matter, for triangles
// without an area and for the same triangle twice. Coordinates up to 10 m.
bool surely_apart(const Facet& a, const Facet& b);

}  // namespace tribo::field
