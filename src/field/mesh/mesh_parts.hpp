// SPDX-License-Identifier: MIT
// A mesh of several bodies, taken apart where they may cross.
#pragma once

#include <cstdint>
#include <vector>

#include "base/mesh.hpp"

namespace tribo::field {

struct MeshPart {
    TriangleMesh mesh;
    bool is_closed = true;
};

// Sorts the connected components of a mesh into parts, so that within a part no boxes of components overlap,
// nor come as near as the thickness of a sheet. Closed and open components are in parts of their own. A
// hollow (a closed component that is inside out) stays with the smallest closed component around its box;
// without one it is turned. Components without an area are left out.
//
// Of a mesh of more than kMostComponents, or where more than kMostParts overlap at one place, what is left
// over comes into one part.
std::vector<MeshPart> parts_of(TriangleMesh mesh, double thickness_mm);
inline constexpr std::size_t kMostComponents = 4096, kMostParts = 16;

// Returns for each vertex the number of its connected component, from 0 in the order of the triangles.
std::vector<std::uint32_t> components_of(const TriangleMesh& mesh, std::size_t& count);

// Adds the triangles of another mesh, which is not connected to the first.
void append(TriangleMesh& to, const TriangleMesh& more);

}  // namespace tribo::field
