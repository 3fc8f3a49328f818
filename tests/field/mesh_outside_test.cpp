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
