// SPDX-License-Identifier: MIT
// Models of several bodies: what a probe touches is their union.
#include "field/mesh/mesh_parts.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "base/draw.hpp"
#include "field/any_mesh.hpp"
#include "field/mesh/mesh_field.hpp"
#include "field/mesh_samples.hpp"

namespace tribo::field {
namespace {

using test::box_mesh;
using test::turned;
using tribo::test::Draw;

// Signed, exact.
double distance_to(const Box3& box, Vec3 p) {
    const Vec3 off{std::max(box.min.x - p.x, p.x - box.max.x), std::max(box.min.y - p.y, p.y - box.max.y),
                   std::max(box.min.z - p.z, p.z - box.max.z)};
    const Vec3 out{std::max(off.x, 0.0), std::max(off.y, 0.0), std::max(off.z, 0.0)};
    return length(out) + std::min(0.0, std::max({off.x, off.y, off.z}));
}

Vec3 any_place(Draw& draw, double half) {
    return {draw.between(-half, half), draw.between(-half, half), draw.between(-half, half)};
}

TEST(MeshParts, of_boxes_that_overlap_are_their_union) {
    const Box3 a{{-3, -3, -3}, {3, 3, 3}}, b{{-1, -1, -6}, {1, 5, 6}}, away{{20, 0, 0}, {22, 2, 2}};
    TriangleMesh mesh;
    for (const Box3& box : {a, b, away}) append(mesh, box_mesh(box));
    EXPECT_EQ(parts_of(mesh, 1).size(), 2);
    const auto field = MeshField::make(mesh);
    ASSERT_TRUE(field);
    EXPECT_FALSE((*field)->is_sheet());
    Draw draw(1, 0);
    for (int n = 0; n < 3000; ++n) {
        const Vec3 p = any_place(draw, 9);
        const double right = std::min({distance_to(a, p), distance_to(b, p), distance_to(away, p)});
        EXPECT_NEAR((*field)->distance_mm(p), right, 1e-9) << p.x << ' ' << p.y << ' ' << p.z;
    }
}

// A block with a hollow, and a block within that; and a block inside out beside it.
TEST(MeshParts, keep_a_hollow_and_what_is_in_it) {
    const Box3 block{{-6, -6, -6}, {6, 6, 6}}, hollow{{-4, -4, -4}, {4, 4, 4}},
        inside{{-1, -1, -1}, {1, 1, 1}}, beside{{10, -2, -2}, {14, 2, 2}};
    TriangleMesh mesh = turned(box_mesh(hollow));
    append(mesh, box_mesh(inside));
    append(mesh, turned(box_mesh(beside)));
    append(mesh, box_mesh(block));
    const auto field = MeshField::make(mesh);
    ASSERT_TRUE(field);
    Draw draw(2, 0);
    for (int n = 0; n < 3000; ++n) {
        const Vec3 p = any_place(draw, 15);
        const double around = std::max(distance_to(block, p), -distance_to(hollow, p));
        EXPECT_EQ((*field)->distance_mm(p) > 0,
                  std::min({around, distance_to(inside, p), distance_to(beside, p)}) > 0)
            << p.x << ' ' << p.y << ' ' << p.z;
    }
}

TEST(MeshParts, mix_a_solid_and_a_sheet) {
    const Box3 block{{-2, -2, -2}, {2, 2, 2}};
    TriangleMesh mesh = box_mesh(block);
    Draw draw(3, 0);
    append(mesh, test::any_sheet(draw));
    const auto field = MeshField::make(mesh, 0.5);
    ASSERT_TRUE(field);
    EXPECT_TRUE((*field)->is_sheet());
    // A solid is deep; so far from the sheet only it is there.
    EXPECT_LT((*field)->distance_mm({0, 0, 0}), -1.5);
}

// In air the distance is that to the nearest triangle of all; a place is in material where the whole mesh
// winds around it. It grows no faster than the way, also where surfaces cross.
TEST(MeshParts, of_random_bodies_agree_with_the_winding_number_and_have_no_steps) {
    for (std::uint64_t n = 0; n < 30; ++n) {
        Draw draw(4, n);
        const TriangleMesh mesh = test::any_two_bodies(draw);
        const MeshTree tree(mesh);
        const auto field = MeshField::make(mesh);
        ASSERT_TRUE(field);
        for (int k = 0; k < 200; ++k) {
            const Vec3 p = any_place(draw, 16);
            const contact::SurfaceSample s = (*field)->sample(p);
            const double nearest = distance(tree.nearest(p).at.point_mm, p);
            EXPECT_EQ(s.distance_mm < 0, tree.winding(p) > 0) << n << ' ' << k;
            // In material a buried surface may be nearer.
            if (s.distance_mm > 0) {
                EXPECT_NEAR(s.distance_mm, nearest, 1e-9) << n << ' ' << k;
            } else {
                EXPECT_LE(nearest, 1e-9 - s.distance_mm) << n << ' ' << k;
            }
            const double far = draw.between(0, 0.01);
            const Vec3 q = p + far * draw.direction();
            EXPECT_LE(std::abs((*field)->distance_mm(q) - s.distance_mm), far + 1e-9) << n << ' ' << k;
        }
    }
}

TEST(MeshParts, leave_out_what_has_no_area) {
    TriangleMesh mesh = box_mesh({{-2, -2, -2}, {2, 2, 2}}), flat;
    flat.positions = {{0, 0, 3}, {1, 0, 3}, {2, 0, 3}};
    flat.triangles = {{0, 1, 2}};
    append(mesh, flat);
    const auto field = MeshField::make(mesh);
    ASSERT_TRUE(field);
    EXPECT_FALSE((*field)->is_sheet());
    EXPECT_EQ((*field)->distance_mm({0, 0, 3}), 1);
}

TEST(MeshParts, of_a_soup_beyond_all_limits_are_few) {
    TriangleMesh tower, many;
    for (int n = 0; n < 40; ++n) append(tower, box_mesh({{-1.0 - n, -1, -1}, {1.0 + n, 1, 1 + 0.1 * n}}));
    EXPECT_EQ(parts_of(tower, 1).size(), kMostParts);
    for (int n = 0; n < 5000; ++n) append(many, box_mesh({{3.0 * n, 0, 0}, {3.0 * n + 1, 1, 1}}));
    EXPECT_EQ(parts_of(many, 1).size(), 1);
}

}  // namespace
}  // namespace tribo::field
