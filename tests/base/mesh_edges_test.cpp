// SPDX-License-Identifier: MIT
#include "base/mesh_edges.hpp"

#include <gtest/gtest.h>

namespace tribo {
namespace {

TriangleMesh tetrahedra(std::uint32_t count) {
    TriangleMesh mesh;
    for (std::uint32_t k = 0; k < count; ++k) {
        const auto x = static_cast<float>(2 * k);
        for (const Point3f& p : {Point3f{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}})
            mesh.positions.push_back(p);
        for (const Triangle& t : {Triangle{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
            mesh.triangles.push_back({t[0] + 4 * k, t[1] + 4 * k, t[2] + 4 * k});
    }
    return mesh;
}

TEST(MeshEdges, ClosedBodiesHavePiecesAndNothingElse) {
    const MeshEdges e = describe_edges(tetrahedra(3));
    EXPECT_EQ(e.pieces, 3U);
    EXPECT_EQ(e.open + e.crowded + e.turned + e.holes, 0U);
}

TEST(MeshEdges, HolesAreRunsOfOpenEdges) {
    TriangleMesh mesh = tetrahedra(2);
    mesh.triangles.erase(mesh.triangles.begin());
    mesh.triangles.pop_back();
    const MeshEdges e = describe_edges(mesh);
    EXPECT_EQ(e.open, 6U);
    EXPECT_EQ(e.holes, 2U);
    EXPECT_EQ(e.pieces, 2U);
}

TEST(MeshEdges, TurnedAndCrowdedEdgesAreTold) {
    TriangleMesh mesh = tetrahedra(1);
    std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
    EXPECT_EQ(describe_edges(mesh).turned, 3U);
    mesh.positions.push_back({1, 1, 1});
    mesh.triangles.push_back({1, 2, 4});
    const MeshEdges e = describe_edges(mesh);
    EXPECT_EQ(e.crowded, 1U);
    EXPECT_EQ(e.open, 2U);
    EXPECT_EQ(e.holes, 1U);
    EXPECT_EQ(describe_edges({}).pieces, 0U);
}

}  // namespace
}  // namespace tribo
