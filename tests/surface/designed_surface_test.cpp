// SPDX-License-Identifier: MIT
// Sides and samples of designed surfaces.
#include "surface/designed_surface.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "grooves.hpp"

namespace tribo::surface {
namespace {

using test::rectangle;

TEST(DesignedSurface, an_open_surface_faces_up_however_it_was_exported) {
    TriangleMesh mesh = rectangle(0, 10, 0, 10);
    for (int turned = 0; turned < 2; ++turned) {
        const auto surface = DesignedSurface::make(mesh);
        ASSERT_TRUE(surface.has_value());
        EXPECT_FALSE(surface->watertight());
        EXPECT_EQ(surface->signed_distance_mm({5, 5, 2}), 2);
        EXPECT_EQ(surface->signed_distance_mm({5, 5, -2}), -2);
        for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
    }
    const auto down = DesignedSurface::make(mesh, {0, 0, -1});
    EXPECT_EQ(down->signed_distance_mm({5, 5, 2}), -2);
}

TEST(DesignedSurface, border_points_are_marked) {
    const auto surface = DesignedSurface::make(rectangle(0, 10, 0, 10));
    EXPECT_FALSE(surface->closest({5, 5, 1}).on_border);
    EXPECT_TRUE(surface->closest({12, 5, 1}).on_border);
    EXPECT_TRUE(surface->closest({12, 12, 1}).on_border);
    EXPECT_DOUBLE_EQ(surface->closest({13, 5, 4}).distance_mm, 5);
}

TEST(DesignedSurface, a_closed_surface_is_turned_outside_out) {
    TriangleMesh mesh{
        {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}, {}};
    const auto surface = DesignedSurface::make(mesh);
    ASSERT_TRUE(surface.has_value());
    EXPECT_TRUE(surface->watertight());
    EXPECT_NEAR(surface->signed_distance_mm({1, 1, -1}), 1, 1e-12);
    EXPECT_LT(surface->signed_distance_mm({0.5, 0.5, 0.5}), 0);
}

// The pieces of a picture meet up to rounding: slits of a micrometre, which face somewhere on the whole by
// chance.
TEST(DesignedSurface, a_surface_with_slits_is_turned_outside_out) {
    for (const float slit : {-1e-3f, 1e-3f}) {
        for (const bool inside_out : {false, true}) {
            TriangleMesh box{
                {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 3}, {3, 0, 3}, {3, 3, 3}, {0, 3, 3}},
                {{0, 2, 1},
                 {0, 3, 2},
                 {0, 1, 5},
                 {0, 5, 4},
                 {1, 2, 6},
                 {1, 6, 5},
                 {2, 3, 7},
                 {2, 7, 6},
                 {3, 0, 4},
                 {3, 4, 7},
                 {8, 9, 10},
                 {8, 10, 11}},
                {}};
            for (std::size_t corner = 4; corner < 8; ++corner) {
                Point3f lid = box.positions[corner];
                lid[0] = 1.5f + (1 + slit) * (lid[0] - 1.5f);
                box.positions.push_back(lid);
            }
            for (Triangle& t : box.triangles) {
                if (inside_out) std::swap(t[0], t[1]);
            }
            const auto surface = DesignedSurface::make(box);
            ASSERT_TRUE(surface.has_value());
            EXPECT_FALSE(surface->watertight());
            for (const Vec3 out : {Vec3{1, 1, -1}, Vec3{1, 1, 4}, Vec3{-1, 1, 1}, Vec3{1, 4, 1}})
                EXPECT_NEAR(surface->signed_distance_mm(out), 1, 1e-6);
            EXPECT_NEAR(surface->signed_distance_mm({1.5, 1.5, 1}), -1, 1e-6);
        }
    }
}

TEST(DesignedSurface, split_vertices_hang_together_and_turned_triangles_are_counted) {
    TriangleMesh soup{
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}, {}};
    EXPECT_FALSE(DesignedSurface::make(soup)->closest({0.5, 0.5, 1}).on_border);
    EXPECT_EQ(DesignedSurface::make(soup)->turned_edges(), 0U);
    std::swap(soup.triangles[1][0], soup.triangles[1][1]);
    soup.positions[4] = {2, 2, 0};
    EXPECT_EQ(DesignedSurface::make(soup)->turned_edges(), 1U);
}

TEST(DesignedSurface, refuses_what_has_no_area) {
    EXPECT_FALSE(DesignedSurface::make({}).has_value());
    EXPECT_FALSE(DesignedSurface::make({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {}}).has_value());
}

// Any triangle: the samples' areas add up to its own, their centre is its centre, and none is far from the
// next.
RC_GTEST_PROP(DesignedSurface, samples_cover_any_triangle_evenly, ()) {
    const auto coordinate =
        rc::gen::map(rc::gen::inRange(-50, 51), [](int i) { return static_cast<float>(i) * 0.1F; });
    TriangleMesh mesh;
    for (int i = 0; i < 3; ++i) mesh.positions.push_back({*coordinate, *coordinate, *coordinate});
    mesh.triangles = {{0, 1, 2}};
    RC_PRE(area_mm2(mesh) > 1e-3);
    const double spacing = 0.1 * *rc::gen::inRange(1, 30);
    const auto surface = DesignedSurface::make(mesh);
    const auto samples = surface->sample(spacing);
    double area = 0;
    Vec3 centre;
    for (const SurfaceSample& s : samples) {
        area += s.area_mm2;
        centre += s.area_mm2 * s.point_mm;
        RC_ASSERT(std::abs(surface->signed_distance_mm(s.point_mm)) < 1e-5);
        RC_ASSERT(s.area_mm2 <= spacing * spacing);
    }
    RC_ASSERT(std::abs(area - area_mm2(mesh)) < 1e-9 * area);
    const Vec3 exact = (mesh.position(0) + mesh.position(1) + mesh.position(2)) / 3;
    RC_ASSERT(distance(centre / area, exact) < 1e-9);
}

}  // namespace
}  // namespace tribo::surface
