// SPDX-License-Identifier: MIT
// Mended meshes: they reach the tips of thin cusps, follow the surface both ways, and stay solids.
#include "field/contour/contour_mend.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "field/contour/contour.hpp"
#include "field/contour/contour_refine.hpp"
#include "field/mesh/mesh_distance.hpp"
#include "field/shape/box_shape.hpp"
#include "self_intersection.hpp"
#include "test_shapes.hpp"

namespace tribo::field {
namespace {

using test::BallPass;
using tribo::test::expect_solid;

TriangleMesh refined(const CarvedField& field) {
    TriangleMesh mesh = contour(field);
    refine(mesh, field, 0.01);
    return mesh;
}

// Two grooves of a ball that leave a cusp: its tip is a line at a known height.
TEST(ContourMend, reaches_the_tip_of_a_cusp_wherever_it_ends_in_a_cell) {
    const double radius = 3, apart = 5.6, half = 0.5 * apart;
    const double tip = -std::sqrt(radius * radius - half * half);
    int points = 0, far_before = 0, far_after = 0;
    for (int n = 0; n < 24; ++n) {
        const double turn = 0.13 * n, c = std::cos(turn), s = std::sin(turn), cell = 0.31 + 0.02 * n;
        CarvedField field(std::make_unique<BoxShape>(Box3{{-9, -9, -6}, {9, 9, 0}}), cell);
        for (const double side : {-half, half}) {
            const Vec3 off{-s * side, c * side, 0.013 * n};
            field.carve(
                std::make_unique<BallPass>(off + 20 * Vec3{c, s, 0}, off - 20 * Vec3{c, s, 0}, radius));
        }
        const TriangleMesh before = refined(field), after = fine_contour(field);
        const MeshDistance to_before(before), to_after(after);
        for (double along = -6; along < 6; along += 0.07) {
            const Vec3 p{c * along, s * along, tip + 0.013 * n};
            const double after_mm = std::abs(to_after.closest(p).distance_mm);
            EXPECT_LT(after_mm, 0.07) << n << " " << along;
            far_before += std::abs(to_before.closest(p).distance_mm) > 0.02 ? 1 : 0;
            far_after += after_mm > 0.02 ? 1 : 0;
            ++points;
        }
        expect_solid(after);
    }
    EXPECT_GT(10 * far_before, points);
    EXPECT_LE(far_after, points / 1000);
}

// Grooves of balls at random, not much wider than a cell. The surface's own points come from a mesh of a
// finer grid.
TEST(ContourMend, of_random_grooves_stays_a_solid_and_comes_nearer_from_both_sides) {
    const CounterNoise noise(33);
    std::uint64_t drawn = 0;
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    std::size_t far_before = 0, far_after = 0;
    for (int n = 0; n < 30; ++n) {
        const double cell = between(0.2, 0.8), fine = cell / 3.7;
        CarvedField field(std::make_unique<BoxShape>(Box3{{0, 0, -6}, {12, 9, 0}}), cell);
        CarvedField truth(std::make_unique<BoxShape>(Box3{{0, 0, -6}, {12, 9, 0}}), fine);
        for (int k = 0; k < 12; ++k) {
            const double radius = cell * between(2, 9), z = radius - between(0.1, 3);
            const Vec3 from{between(-2, 14), between(-2, 11), z}, to{between(-2, 14), between(-2, 11), z};
            field.carve(std::make_unique<BallPass>(from, to, radius));
            truth.carve(std::make_unique<BallPass>(from, to, radius));
        }
        const TriangleMesh before = refined(field), after = fine_contour(field), points = contour(truth);
        const MeshDistance to_before(before), to_after(after);
        for (std::uint32_t v = 0; v < points.positions.size(); ++v) {
            const Vec3 p = points.position(v);
            if (std::abs(field.distance_mm(p)) > 1e-3) continue;
            far_before += std::abs(to_before.closest(p).distance_mm) > 0.02 ? 1 : 0;
            far_after += std::abs(to_after.closest(p).distance_mm) > 0.02 ? 1 : 0;
        }
        double off_before = 0, off_after = 0;
        for (std::uint32_t v = 0; v < before.positions.size(); ++v)
            off_before = std::max(off_before, std::abs(field.distance_mm(before.position(v))));
        for (std::uint32_t v = 0; v < after.positions.size(); ++v)
            off_after = std::max(off_after, std::abs(field.distance_mm(after.position(v))));
        EXPECT_LE(off_after, off_before + 1e-3) << n;
        EXPECT_NEAR(volume_mm3(after), volume_mm3(before), 0.002 * volume_mm3(before)) << n;
        expect_solid(after);
    }
    EXPECT_GT(far_before, 1000u);
    EXPECT_LT(20 * far_after, far_before);
}

TEST(ContourMend, changes_nothing_where_the_mesh_is_on_the_surface) {
    CarvedField field(std::make_unique<BoxShape>(Box3{{-10, -10, -9}, {10, 10, 0}}), 0.5);
    field.carve(std::make_unique<BoxShape>(Box3{{-3.1, -20, -4.2}, {2.7, 20, 5}}));
    TriangleMesh mesh = contour(field);
    const TriangleMesh before = mesh;
    std::vector<std::uint32_t> all;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) all.push_back(v);
    mend(mesh, field, 0.01, all);
    EXPECT_EQ(mesh.triangles, before.triangles);
    EXPECT_EQ(mesh.positions, before.positions);
}

TEST(ContourMend, does_not_depend_on_the_order_of_the_work) {
    CarvedField field(std::make_unique<BoxShape>(Box3{{-10, -10, -9}, {10, 10, 0}}), 0.6);
    for (const double y : {-2.7, 2.6, 7.1})
        field.carve(std::make_unique<BallPass>(Vec3{-12, y, 0.2}, Vec3{12, 1.4 * y, 0.2}, 3));
    const TriangleMesh forth = fine_contour(field);
    const TriangleMesh back =
        fine_contour(field, [](std::size_t count, const std::function<void(std::size_t)>& body) {
            for (std::size_t n = count; n-- > 0;) body(n);
        });
    EXPECT_EQ(forth.triangles, back.triangles);
    EXPECT_EQ(forth.positions, back.positions);
}

}  // namespace
}  // namespace tribo::field
