// SPDX-License-Identifier: MIT
// The proof that two triangles are apart, against the exact test of whether they meet.
#include "field/mesh/triangles_apart.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "self_intersection.hpp"

namespace tribo::field {
namespace {

// Two triangles with so many common vertices. On a coarse lattice many corners lie in one plane or on edges
// of the other triangle.
TriangleMesh pair_of_triangles(const CounterNoise& noise, std::uint64_t& drawn, int shared, bool on_lattice) {
    const auto coordinate = [&] {
        const double c = 4 * noise.uniform(drawn++);
        return static_cast<float>(on_lattice ? std::floor(c) : c);
    };
    TriangleMesh mesh;
    while (mesh.positions.size() < static_cast<std::size_t>(6 - shared)) {
        const Point3f p{coordinate(), coordinate(), coordinate()};
        if (std::find(mesh.positions.begin(), mesh.positions.end(), p) == mesh.positions.end())
            mesh.positions.push_back(p);
    }
    const auto v = [&](int n) { return static_cast<std::uint32_t>(n); };
    mesh.triangles = {{0, 1, 2},
                      shared == 0   ? Triangle{3, 4, 5}
                      : shared == 1 ? Triangle{v(3), v(4), 2}
                                    : Triangle{v(3), 2, 1}};
    return mesh;
}

TEST(TrianglesApart, is_true_only_of_triangles_that_do_not_meet) {
    const CounterNoise noise(7);
    std::uint64_t drawn = 0;
    for (int shared = 0; shared < 3; ++shared) {
        for (const bool on_lattice : {false, true}) {
            int apart = 0, proven = 0;
            for (int n = 0; n < 20000; ++n) {
                const TriangleMesh mesh = pair_of_triangles(noise, drawn, shared, on_lattice);
                const bool meet = !tribo::test::SelfIntersections(mesh).pairs().empty();
                const Facet a{mesh.triangles[0], corners(mesh, mesh.triangles[0])};
                const Facet b{mesh.triangles[1], corners(mesh, mesh.triangles[1])};
                const bool sure = surely_apart(a, b);
                EXPECT_EQ(sure, surely_apart(b, a)) << shared << " " << n;
                EXPECT_FALSE(sure && meet) << shared << " " << on_lattice << " " << n;
                apart += meet ? 0 : 1;
                proven += sure ? 1 : 0;
            }
            // What is left are triangles that nearly touch, or are nearly folded at their edge.
            EXPECT_GT(apart, 2000) << shared;
            EXPECT_GT(proven, 0.99 * apart) << shared << " " << on_lattice;
        }
    }
}

TEST(TrianglesApart, is_false_of_a_triangle_and_itself) {
    const Facet a{{0, 1, 2}, {Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    EXPECT_FALSE(surely_apart(a, a));
    EXPECT_FALSE(surely_apart(a, {{0, 2, 1}, {a.at[0], a.at[2], a.at[1]}}));
}

}  // namespace
}  // namespace tribo::field
