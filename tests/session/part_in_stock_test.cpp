// SPDX-License-Identifier: MIT
#include "session/cut/part_in_stock.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "field/mesh/mesh_shape.hpp"
#include "field/shape/box_shape.hpp"

namespace tribo::session {
namespace {

// Corner i stands at max.x for bit 0, max.y for bit 1, max.z for bit 2.
TriangleMesh box_mesh(const Box3& box) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        const Vec3 p{i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                     i & 4 ? box.max.z : box.min.z};
        mesh.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

TriangleMesh octahedron(Vec3 centre, double radius) {
    TriangleMesh mesh;
    for (const Vec3 way :
         {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
        const Vec3 p = centre + radius * way;
        mesh.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return mesh;
}

TEST(PartInStock, that_fits_is_not_warned_of) {
    const field::BoxShape blank({{0, 0, -20}, {60, 60, 0}});
    EXPECT_FALSE(farthest_outside(box_mesh({{0, 0, -20}, {60, 60, 0}}), blank).has_value());
    EXPECT_FALSE(farthest_outside(box_mesh({{5, 5, -20}, {60, 60, 0.009}}), blank).has_value());
    Warnings warnings;
    warn_of_part_outside(box_mesh({{5, 5, -10}, {6, 6, 0}}), blank, "j.toml", warnings);
    EXPECT_TRUE(warnings.empty());
}

TEST(PartInStock, that_stands_out_is_warned_of_with_how_far_and_where) {
    const field::BoxShape blank({{0, 0, -20}, {60, 60, 0}});
    Warnings warnings;
    warn_of_part_outside(box_mesh({{5, 5, -10}, {50, 50, 1.5}}), blank, "j.toml", warnings);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0].file, "j.toml");
    EXPECT_NE(warnings[0].text.find("1.5 mm out of the stock at (5, 5, 1.5) mm"), std::string::npos)
        << warnings[0].text;
}

// An open surface that bends over the edge of the stock, as a VRML surface may.
TEST(PartInStock, may_be_an_open_surface) {
    const TriangleMesh sheet{
        {{0, 0, -1}, {10, 0, -1}, {12.5F, 5, -1}, {0, 10, -1}}, {{0, 1, 2}, {0, 2, 3}}, {}};
    const auto outside = farthest_outside(sheet, field::BoxShape({{0, 0, -5}, {10, 10, 0}}));
    ASSERT_TRUE(outside.has_value());
    EXPECT_DOUBLE_EQ(outside->mm, 2.5);
    EXPECT_EQ(outside->at_mm, (Vec3{12.5, 5, -1}));
}

TEST(PartInStock, of_two_triangles_a_side_is_seen_over_a_notch_in_the_blank) {
    // The blank is a ring of blocks without its middle: a cube whose top corners alone are in it. Every
    // corner of the part is inside, its top is not.
    TriangleMesh notched = box_mesh({{0, 0, 0}, {30, 30, 20}});
    // Top face replaced by a pit to (15, 15, 5).
    notched.positions.push_back({15, 15, 5});
    std::erase_if(notched.triangles, [&](const Triangle& t) {
        return notched.positions[t[0]][2] == 20 && notched.positions[t[1]][2] == 20 &&
               notched.positions[t[2]][2] == 20;
    });
    for (const auto& [a, b] : {std::pair{4U, 5U}, {5U, 7U}, {7U, 6U}, {6U, 4U}})
        notched.triangles.push_back({a, b, 8});
    const auto blank = field::MeshShape::make(notched);
    ASSERT_TRUE(blank.has_value()) << blank.error().text();
    const auto outside = farthest_outside(box_mesh({{0, 0, 0}, {30, 30, 20}}), **blank);
    ASSERT_TRUE(outside.has_value());
    // From the middle of the opening to a face of the pit: it falls 15 mm on 15 mm, so 45 degrees.
    EXPECT_NEAR(outside->mm, 15 * std::sqrt(0.5), 0.2);
    EXPECT_NEAR(outside->at_mm.x, 15, 0.5);
    EXPECT_NEAR(outside->at_mm.y, 15, 0.5);
}

// An octahedron in a box: what stands out is its radius less the least way to a face.
RC_GTEST_PROP(PartInStock, of_an_octahedron_in_a_box_stands_out_by_the_radius_less_the_room, ()) {
    const auto drawn = [](int low, int high) { return 0.01 * *rc::gen::inRange(100 * low, 100 * high + 1); };
    const Vec3 centre{drawn(-30, 30), drawn(-30, 30), drawn(-30, 30)};
    const double radius = drawn(1, 40);
    const Box3 box{{-20, -25, -15}, {drawn(1, 40), drawn(1, 40), drawn(1, 40)}};
    double room = 1e9;
    for (int axis = 0; axis < 3; ++axis)
        room = std::min({room, centre[axis] - box.min[axis], box.max[axis] - centre[axis]});
    const auto outside = farthest_outside(octahedron(centre, radius), field::BoxShape(box));
    if (radius - room > kOutsideMm + 1e-4) {
        RC_ASSERT(outside.has_value());
        RC_ASSERT(std::abs(outside->mm - (radius - room)) < 1e-4);
    } else if (radius - room < kOutsideMm - 1e-4) {
        RC_ASSERT(!outside.has_value());
    }
}

}  // namespace
}  // namespace tribo::session
