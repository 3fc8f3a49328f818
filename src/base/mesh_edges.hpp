// SPDX-License-Identifier: MIT
// How the triangles of a mesh are connected.
#pragma once

#include <cstdint>

#include "base/mesh.hpp"

namespace tribo {

struct MeshEdges {
    std::uint64_t open = 0;     // edges of one triangle
    std::uint64_t crowded = 0;  // edges of more than two
    std::uint64_t turned = 0;   // edges of two triangles that traverse them the same way: one is inside out
    std::uint64_t holes = 0;    // connected runs of open edges
    std::uint64_t pieces = 0;   // groups of triangles that are connected by corners
};

// Works by indices: weld meshes whose corners are stored more than once. By sorting, n log n; uses 36 bytes
// per triangle meanwhile.
MeshEdges describe_edges(const TriangleMesh& mesh);

}  // namespace tribo
