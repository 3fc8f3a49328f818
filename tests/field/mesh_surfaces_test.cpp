// SPDX-License-Identifier: MIT
// Models whose triangles do not say what is connected, against the same models said well.
#include "field/mesh/mesh_surfaces.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "base/draw.hpp"
#include "base/mesh_edges.hpp"
#include "field/any_mesh.hpp"
#include "field/mesh/mesh_field.hpp"
#include "field/mesh_samples.hpp"

namespace tribo::field {
namespace {

using test::box_mesh;
using test::turned;
using tribo::test::Draw;

TriangleMesh with(TriangleMesh mesh, const TriangleMesh& other) {
    append(mesh, other);
    return mesh;
}
// Upright, at x = 0.
TriangleMesh wall(double y, double z_low, double z_high) {
    TriangleMesh mesh;
    mesh.positions = {to_float({0, -y, z_low}), to_float({0, y, z_low}), to_float({0, y, z_high}),
                      to_float({0, -y, z_high})};
    test::add_quad(mesh, 0, 1, 2, 3);
    return mesh;
}

void expect_same(const TriangleMesh& mesh, const TriangleMesh& good, double half, const char* what) {
    const auto field = MeshField::make(mesh), right = MeshField::make(good);
    ASSERT_TRUE(field && right);
    EXPECT_EQ((*field)->is_sheet(), (*right)->is_sheet()) << what;
    EXPECT_EQ((*field)->skin_mm(), (*right)->skin_mm()) << what;
    Draw draw(5, 0);
    for (int n = 0; n < 2000; ++n) {
        const Vec3 p = draw.aside(half, -half, half);
        EXPECT_NEAR((*field)->distance_mm(p), (*right)->distance_mm(p), 1e-9) << what;
    }
}

TEST(MeshSurfaces, that_are_there_twice_count_once) {
    Draw draw(1, 0);
    const TriangleMesh ball = test::any_bumpy_ball(draw), sheet = test::any_sheet(draw);
    expect_same(with(ball, ball), ball, 12, "ball");
    expect_same(with(with(sheet, sheet), sheet), sheet, 9, "sheet");
    TriangleMesh one_more = ball;
    one_more.triangles.push_back(one_more.triangles[7]);
    expect_same(one_more, ball, 12, "one triangle");
}

TEST(MeshSurfaces, between_two_blocks_are_none) {
    const TriangleMesh left = box_mesh({{-4, -2, -2}, {0, 2, 2}}), right = box_mesh({{0, -2, -2}, {3, 2, 2}});
    expect_same(with(left, right), box_mesh({{-4, -2, -2}, {3, 2, 2}}), 5, "face on face");
}

// As a tool that mirrors a half writes it: the other half is inside out.
TEST(MeshSurfaces, of_a_half_and_its_mirror_image_are_those_of_the_whole) {
    const TriangleMesh left = box_mesh({{-4, -2, -2}, {0, 2, 2}}), right = box_mesh({{0, -2, -2}, {3, 2, 2}});
    const TriangleMesh whole = box_mesh({{-4, -2, -2}, {3, 2, 2}});
    expect_same(with(left, turned(right)), whole, 5, "one inside out");
    expect_same(with(turned(left), right), whole, 5, "the other one");
    expect_same(with(turned(left), turned(right)), whole, 5, "both");
    expect_same(with(with(left, turned(right)), box_mesh({{3, -2, -2}, {4, 2, 2}})),
                box_mesh({{-4, -2, -2}, {4, 2, 2}}), 5, "the middle one of three");
    // A box with a hollow is no such body: what the hollow shares with the box has two sides.
    const TriangleMesh hollow = with(whole, turned(box_mesh({{-3, -1, -1}, {2, 1, 1}})));
    expect_same(with(hollow, turned(box_mesh({{3, -2, -2}, {4, 2, 2}}))),
                with(box_mesh({{-4, -2, -2}, {4, 2, 2}}), turned(box_mesh({{-3, -1, -1}, {2, 1, 1}}))), 5,
                "beside a hollow");
}

TEST(MeshSurfaces, with_both_sides_are_a_skin) {
    Draw draw(2, 0);
    const TriangleMesh sheet = test::any_sheet(draw);
    const auto field = MeshField::make(with(sheet, turned(sheet)));
    ASSERT_TRUE(field);
    EXPECT_TRUE((*field)->is_two_sided());
    EXPECT_GT((*field)->skin_mm(), 0);
    const Vec3 at = sheet.position(sheet.triangles[3][0]);
    EXPECT_NEAR((*field)->distance_mm(at), -0.5 * (*field)->skin_mm(), 1e-6);
}

// A block with a wall across its inside that is no body of its own: three faces meet at its edges.
TEST(MeshSurfaces, that_end_at_a_closed_one_leave_it_closed) {
    // Its long edges in two parts, so that the wall has corners to meet.
    TriangleMesh block = with(box_mesh({{-4, -2, -2}, {0, 2, 2}}), box_mesh({{0, -2, -2}, {4, 2, 2}}));
    weld_exactly(block);
    EXPECT_FALSE(drop_twins(block));
    TriangleMesh walled = with(block, wall(2, -2, 2));
    weld_exactly(walled);
    EXPECT_GT(describe_edges(walled).crowded, 0U);
    part_at_crowded_edges(walled);
    EXPECT_EQ(describe_edges(walled).crowded, 0U);
    const auto field = MeshField::make(walled);
    ASSERT_TRUE(field);
    EXPECT_TRUE((*field)->is_solid());
    Draw draw(3, 0);
    const Box3 box{{-4, -2, -2}, {4, 2, 2}};
    for (int n = 0; n < 2000; ++n) {
        Vec3 p = draw.aside(5, -5, 5);
        if (n % 4 == 0) p.x = 0;  // over the edges where three meet
        const Vec3 off{std::max({0.0, -4 - p.x, p.x - 4}), std::max({0.0, -2 - p.y, p.y - 2}),
                       std::max({0.0, -2 - p.z, p.z - 2})};
        const double far = length(off);
        if (far > 0)
            EXPECT_NEAR((*field)->distance_mm(p), far, 1e-9);
        else
            EXPECT_LT((*field)->distance_mm(p), 1e-9);
        EXPECT_EQ(far > 0, !box.contains(p));
    }
}

// A book whose pages all meet at one edge: not every pair of them is looked at.
TEST(MeshSurfaces, of_a_crowd_at_one_edge_take_no_time) {
    TriangleMesh book;
    book.positions = {{0, 0, 0}, {0, 0, 5}};
    for (std::uint32_t n = 0; n < 200'000; ++n) {
        const double angle = math::kTwoPi * n / 200'000;
        book.positions.push_back(to_float({5 * math::cos(angle), 5 * math::sin(angle), 2}));
        book.triangles.push_back(n % 2 == 0 ? Triangle{0, 1, n + 2} : Triangle{1, 0, n + 2});
    }
    const std::size_t pages = book.triangles.size();
    EXPECT_FALSE(drop_twins(book));
    part_at_crowded_edges(book);
    EXPECT_EQ(book.triangles.size(), pages);
    EXPECT_EQ(describe_edges(book).crowded, 0U);
}

TEST(MeshSurfaces, stay_as_they_are_where_two_meet_at_every_edge) {
    Draw draw(4, 0);
    for (const TriangleMesh& good :
         {test::any_bumpy_ball(draw), test::any_sheet(draw), test::any_tube(draw)}) {
        TriangleMesh mesh = good;
        EXPECT_FALSE(drop_twins(mesh));
        part_at_crowded_edges(mesh);
        EXPECT_EQ(mesh.triangles, good.triangles);
        EXPECT_EQ(mesh.positions, good.positions);
    }
}

}  // namespace
}  // namespace tribo::field
