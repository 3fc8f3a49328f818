// SPDX-License-Identifier: MIT
#include "base/mesh_edges.hpp"

#include <algorithm>

#include "base/groups.hpp"

namespace tribo {
namespace {

// An edge and the direction in which a triangle traverses it.
struct Side {
    std::uint32_t low, high;
    bool upward;

    bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

// The number of sets that contain a marked vertex.
std::uint64_t count(Groups& groups, const std::vector<bool>& marked) {
    std::vector<bool> met(groups.size());
    std::uint64_t sets = 0;
    for (std::uint32_t i = 0; i < groups.size(); ++i) {
        if (!marked[i] || met[groups.of(i)]) continue;
        met[groups.of(i)] = true;
        ++sets;
    }
    return sets;
}

}  // namespace

MeshEdges describe_edges(const TriangleMesh& mesh) {
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    Groups pieces(mesh.positions.size()), rims(mesh.positions.size());
    std::vector<bool> used(mesh.positions.size()), on_rim(mesh.positions.size());
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), a < b});
            pieces.join(a, b);
            used[a] = true;
        }
    }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
    MeshEdges out;
    for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
        std::size_t upward = 0;
        for (end = first; end < sides.size() && sides[end].same_edge(sides[first]); ++end) {
            upward += sides[end].upward;
        }
        const std::size_t triangles = end - first;
        out.crowded += triangles > 2;
        out.turned += triangles == 2 && upward != 1;
        if (triangles > 1) continue;
        ++out.open;
        on_rim[sides[first].low] = on_rim[sides[first].high] = true;
        rims.join(sides[first].low, sides[first].high);
    }
    out.holes = count(rims, on_rim);
    out.pieces = count(pieces, used);
    return out;
}

}  // namespace tribo
