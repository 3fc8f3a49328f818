// SPDX-License-Identifier: MIT
// Solids whose mesh passes through itself, against the solid angles of their triangles (van Oosterom and
// Strackee 1983), which know nothing of nearest places.
#include "field/mesh/mesh_outside.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/draw.hpp"
#include "field/any_mesh.hpp"
#include "field/mesh/mesh_distance.hpp"
#include "field/mesh/mesh_field.hpp"
#include "field/mesh_samples.hpp"

namespace tribo::field {
namespace {

using test::box_mesh;
using tribo::test::Draw;

bool is_material(const TriangleMesh& mesh, Vec3 p) {
    return std::abs(test::turns_about(mesh, p)) > 0.5;
}

// Around a place is only material, or only air, as far as the distance says. Whether the other one is seen
// there: a sliver of air is hardly seen.
bool is_exact(const TriangleMesh& mesh, const MeshDistance& solid, Vec3 p, Draw& draw) {
    constexpr double kBeyond = 2e-3;  // mm
    const MeshPoint at = solid.closest(p);
    const double far = std::abs(at.distance_mm);
    const bool inside = is_material(mesh, p);
    if (far < kBeyond) return true;
    EXPECT_EQ(at.distance_mm < 0, inside) << p.x << ' ' << p.y << ' ' << p.z << " at " << at.distance_mm;
    EXPECT_NEAR(distance(p, at.point_mm), far, 1e-9);
    const Vec3 on = normalized(at.point_mm - p);
    EXPECT_GT((inside ? 1 : -1) * dot(on, at.normal), 0);
    bool other = false;
    for (int n = 0; n < 20; ++n) {
        const double share = draw.between(0, 1);
        const Vec3 to = draw.direction();
        EXPECT_EQ(is_material(mesh, p + 0.999 * std::cbrt(share) * far * to), inside)
            << p.x << ' ' << p.y << ' ' << p.z << " at " << at.distance_mm;
    }
    // At a sharp corner that is a small share of all directions.
    for (int n = 0; n < 2000 && !other; ++n)
        other = is_material(mesh, at.point_mm + kBeyond * draw.direction()) != inside;
    return other;
}

TEST(MeshOutside, is_none_of_a_mesh_that_does_not_pass_through_itself) {
    Draw draw(1, 0);
    for (const TriangleMesh& mesh : {box_mesh({{-1, -2, -3}, {1, 2, 3}}), test::sphere_mesh({1, 2, 3}, 5, 3),
                                     test::any_bumpy_ball(draw), test::any_star(draw, true)})
        EXPECT_FALSE(MeshOutside::of(mesh, MeshTree(mesh)));
}

// Two boxes as one mesh: a cross. Faces in one plane lie on each other.
TEST(MeshOutside, of_two_boxes_is_that_of_their_union) {
    Draw draw(2, 0);
    for (const double top : {2.0, 5.0}) {
        TriangleMesh mesh = box_mesh({{-6, -2, -2}, {6, 2, 2}});
        append(mesh, box_mesh({{-2, -6, -2}, {2, 6, top}}));
        const MeshDistance solid = MeshDistance::of_solid(mesh);
        for (int n = 0; n < 1000; ++n) EXPECT_TRUE(is_exact(mesh, solid, draw.aside(7, -3, 6), draw));
        // The middle of the cross, where four faces are within the material.
        EXPECT_NEAR(solid.closest({0, 0, 0}).distance_mm, -2, 1e-6);
        EXPECT_NEAR(solid.closest({1.5, 1.5, 0}).distance_mm, -std::sqrt(0.5), 1e-5);
    }
}

Box3 any_box(Draw& draw) {
    // Of whole numbers, so that faces often lie in one plane.
    const auto whole = [&draw](double from, double to) { return std::floor(draw.between(from, to)); };
    const double x = whole(0, 5), y = whole(0, 5), z = whole(0, 5);
    const double a = whole(1, 5), b = whole(1, 5), c = whole(1, 5);
    return {{x, y, z}, {x + a, y + b, z + c}};
}

void turn_inside_out(TriangleMesh& mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

// Against the unit cubes of the lattice: boxes beside, in, on and through each other, some inside out.
TEST(MeshOutside, has_the_volume_of_boxes_that_share_places_once) {
    int solids = 0;
    for (int n = 0; n < 1000; ++n) {
        Draw draw(5, static_cast<std::uint64_t>(n));
        TriangleMesh mesh;
        for (int k = 0; k < 3; ++k) {
            TriangleMesh box = box_mesh(any_box(draw));
            if (draw.by_chance(0.25)) turn_inside_out(box);
            append(mesh, box);
        }
        double cubes = 0;
        for (int x = 0; x < 10; ++x) {
            for (int y = 0; y < 10; ++y) {
                for (int z = 0; z < 10; ++z)
                    cubes += is_material(mesh, {x + 0.47, y + 0.51, z + 0.53}) ? 1 : 0;
            }
        }
        if (!MeshOutside::of(mesh, MeshTree(mesh))) continue;
        ++solids;
        EXPECT_NEAR(MeshDistance::of_solid(mesh).volume_mm3(), cubes, 2e-4 * cubes) << n;
    }
    EXPECT_GT(solids, 800);
}

// Turned, so that faces are in one plane but for rounding, and away from the origin.
TEST(MeshOutside, has_the_volume_of_a_box_of_two_that_overlap) {
    for (int n = 0; n < 500; ++n) {
        Draw draw(6, static_cast<std::uint64_t>(n));
        const double a = draw.between(1, 9), b = draw.between(0, a);
        const double y = draw.between(1, 5), z = draw.between(1, 5);
        TriangleMesh mesh = box_mesh({{0, 0, 0}, {a, y, z}});
        append(mesh, box_mesh({{b, 0, 0}, {10, y, z}}));
        const Vec3 along = draw.direction();
        const Vec3 across = normalized(cross(along, draw.direction())), up = cross(along, across);
        const Vec3 away = draw.between(0, 100) * draw.direction();
        for (Point3f& p : mesh.positions) {
            const Vec3 at = to_double(p);
            p = to_float(away + at.x * along + at.y * across + at.z * up);
        }
        EXPECT_NEAR(MeshDistance::of_solid(mesh).volume_mm3(), 10 * y * z, 1e-3 * y * z) << n;
    }
}

TEST(MeshOutside, has_the_volume_of_what_any_mesh_winds_around) {
    constexpr int kEdge = 40;
    for (int n = 0; n < 20; ++n) {
        Draw draw(7, static_cast<std::uint64_t>(n));
        const TriangleMesh mesh = n % 2 == 0 ? test::any_tube(draw) : test::any_crumpled_ball(draw);
        const MeshDistance solid = MeshDistance::of_solid(mesh);
        const Box3 box = solid.bounds_mm();
        const Vec3 step = (1.0 / kEdge) * box.size();
        int in = 0;
        for (int k = 0; k < kEdge * kEdge * kEdge; ++k) {
            const Vec3 share{draw.between(0, 1), draw.between(0, 1), draw.between(0, 1)};
            const int x = k % kEdge, y = k / kEdge % kEdge, z = k / kEdge / kEdge;
            const Vec3 at{(x + share.x) * step.x, (y + share.y) * step.y, (z + share.z) * step.z};
            in += solid.winding(box.min + at) != 0 ? 1 : 0;
        }
        const double cell = step.x * step.y * step.z;
        // Six deviations of a place drawn in each cell of the surface.
        EXPECT_NEAR(solid.volume_mm3(), in * cell, 6 * cell * std::sqrt(in)) << n;
    }
}

// A body within another one: no wall is felt there.
TEST(MeshOutside, is_that_of_the_outer_body) {
    Draw draw(8, 0);
    for (const bool is_hollow : {false, true}) {
        TriangleMesh mesh = box_mesh({{-5, -5, -5}, {5, 5, 5}});
        TriangleMesh inner = test::sphere_mesh({1, 0, 0}, 2, 3);
        if (is_hollow) turn_inside_out(inner);
        append(mesh, inner);
        const MeshDistance solid = MeshDistance::of_solid(mesh);
        EXPECT_NEAR(solid.closest({1, 0, 0}).distance_mm, is_hollow ? 2 : -4, 0.05);
        EXPECT_NEAR(solid.volume_mm3(),
                    1000 - (is_hollow ? volume_mm3(test::sphere_mesh({1, 0, 0}, 2, 3)) : 0), 1e-3);
        for (int n = 0; n < 300; ++n) EXPECT_TRUE(is_exact(mesh, solid, draw.aside(7, -3, 6), draw));
    }
}

TEST(MeshOutside, of_any_mesh_bounds_what_it_winds_around) {
    constexpr int kScenes = 40, kPlaces = 30;
    int crossed = 0, unseen = 0;
    for (int n = 0; n < kScenes; ++n) {
        Draw draw(3, static_cast<std::uint64_t>(n));
        const TriangleMesh mesh = n % 2 == 0 ? test::any_tube(draw) : test::any_crumpled_ball(draw);
        crossed += MeshOutside::of(mesh, MeshTree(mesh)) ? 1 : 0;
        const MeshDistance solid = MeshDistance::of_solid(mesh);
        const Box3 box = solid.bounds_mm();
        for (int k = 0; k < kPlaces; ++k) {
            const Vec3 share{draw.between(0, 1), draw.between(0, 1), draw.between(0, 1)};
            const Vec3 size = box.size();
            const Vec3 p = box.min + Vec3{share.x * size.x, share.y * size.y, share.z * size.z};
            unseen += is_exact(mesh, solid, p, draw) ? 0 : 1;
        }
    }
    EXPECT_GT(crossed, kScenes / 2);
    EXPECT_LE(unseen, 1 + kScenes * kPlaces / 500);
}

}  // namespace
}  // namespace tribo::field
