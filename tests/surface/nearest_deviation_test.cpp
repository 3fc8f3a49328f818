// SPDX-License-Identifier: MIT
// Rest and gouge count to the nearest point of the design: missing and unwanted features, corners, folds of
// a mesh, and boxes at random against a search of all points.
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "field/carved/carved_field.hpp"
#include "field/shape/box_shape.hpp"
#include "field/shape/surface_points.hpp"
#include "surface/deviation.hpp"

namespace tribo::surface {
namespace {

constexpr double kLength = 40;

// A solid that is the same from y = 0 to kLength: its outline in (x, z), counter-clockwise seen from -y, as a
// fan of the given triangles at the ends.
TriangleMesh prism(const std::vector<std::array<float, 2>>& outline, const std::vector<Triangle>& ends) {
    TriangleMesh mesh;
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (const double y : {0.0, kLength}) {
        for (const auto& p : outline) mesh.positions.push_back({p[0], static_cast<float>(y), p[1]});
    }
    for (const Triangle& t : ends) {
        mesh.triangles.push_back(t);
        mesh.triangles.push_back({t[0] + n, t[2] + n, t[1] + n});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        mesh.triangles.push_back({i, i + n, j});
        mesh.triangles.push_back({j, i + n, j + n});
    }
    return mesh;
}

// A plate 40 mm wide and 10 mm thick, with a rib 2 mm thick and 30 mm high on it, or a slot as deep and wide.
TriangleMesh plate_with_rib() {
    return prism({{0, 0}, {40, 0}, {40, 10}, {21, 10}, {21, 40}, {19, 40}, {19, 10}, {0, 10}},
                 {{0, 1, 3}, {1, 2, 3}, {0, 3, 6}, {0, 6, 7}, {3, 4, 5}, {3, 5, 6}});
}
TriangleMesh block_with_slot() {
    return prism({{0, 0}, {40, 0}, {40, 40}, {21, 40}, {21, 10}, {19, 10}, {19, 40}, {0, 40}},
                 {{0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 7}, {5, 6, 7}});
}

DesignedSurface design_of(const TriangleMesh& mesh) {
    auto made = DesignedSurface::make(mesh);
    EXPECT_TRUE(made.has_value());
    EXPECT_TRUE(made->watertight());
    return std::move(*made);
}

field::CarvedField box_field(const Box3& box, double cell_mm = 0.5) {
    return field::CarvedField(std::make_unique<field::BoxShape>(box), cell_mm);
}

DeviationReport compared(const field::CarvedField& machined, const DesignedSurface& designed,
                         double spacing_mm) {
    const std::vector<Vec3> points = field::surface_points(machined, 100'000);
    return compare(machined, designed, {.spacing_mm = spacing_mm, .machined_mm = points});
}

TEST(NearestDeviation, a_missing_rib_is_a_gouge_of_half_its_thickness) {
    const auto machined = box_field({{0, 0, 0}, {40, kLength, 10}});
    const auto report = compared(machined, design_of(plate_with_rib()), 0.5);
    EXPECT_NEAR(report.gouge.mm, 1, 0.01);
    EXPECT_LT(report.rest.mm, 1e-6);
    // Both sides of the rib share what is missing; its narrow faces see the middle again, a triangle's worth.
    EXPECT_NEAR(report.gouge_mm3, 2 * 30 * kLength, 0.06 * 2 * 30 * kLength);
}

TEST(NearestDeviation, a_slot_that_was_not_cut_is_rest_of_half_its_width) {
    const auto machined = box_field({{0, 0, 0}, {40, kLength, 40}});
    const auto report = compared(machined, design_of(block_with_slot()), 0.5);
    EXPECT_NEAR(report.rest.mm, 1, 0.01);
    EXPECT_LT(report.gouge.mm, 1e-6);
    EXPECT_EQ(report.unmeasured_mm2, 0);
}

TEST(NearestDeviation, the_corner_of_a_blank_that_was_left_counts_to_the_corner_of_the_design) {
    const auto machined = box_field({{0, 0, 0}, {20, 20, 20}});
    const auto designed = design_of(prism({{0, 0}, {17, 0}, {17, 16}, {0, 16}}, {{0, 1, 2}, {0, 2, 3}}));
    const auto report = compared(machined, designed, 0.5);
    // The design is longer than the blank by 20 mm at y = 40: missing there, as deep as it is thick.
    EXPECT_NEAR(report.rest.mm, 5, 1e-4);
    EXPECT_NEAR(report.gouge.mm, 8, 0.1);
}

TEST(NearestDeviation, a_rib_cut_too_thin_on_one_side_is_gouged_by_as_much) {
    auto machined = box_field({{0, 0, 0}, {40, kLength, 40}});
    const Box3 cuts[] = {{{-1, -1, 10}, {19.3, 41, 41}}, {{21, -1, 10}, {41, 41, 41}}};
    for (const Box3& cut : cuts) machined.carve(std::make_unique<field::BoxShape>(cut));
    const auto report = compared(machined, design_of(plate_with_rib()), 0.5);
    EXPECT_NEAR(report.gouge.mm, 0.3, 1e-6);
    EXPECT_LT(report.rest.mm, 1e-6);
}

// No face of the design is in the blank: what was cut away or is left over is seen from the machined side.
TEST(NearestDeviation, of_a_design_around_or_beside_the_blank_is_that_of_the_machined_side) {
    const Box3 box{{0, 0, 0}, {40, kLength, 10}};
    auto machined = box_field(box);
    machined.carve(std::make_unique<field::BoxShape>(Box3{{18, -1, 4}, {22, 41, 11}}));
    const auto compared_with = [&](double low, double high, double aside) {
        const std::vector<Vec3> points = field::surface_points(machined, 100'000);
        TriangleMesh mesh = prism({{0, 0}, {40, 0}, {40, 10}, {0, 10}}, {{0, 1, 2}, {0, 2, 3}});
        for (Point3f& p : mesh.positions) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                p[axis] = static_cast<float>(p[axis] == 0 ? low : static_cast<double>(p[axis]) + high);
            p[0] += static_cast<float>(aside);
        }
        const field::BoxShape blank(box);
        return compare(machined, design_of(mesh), {.blank = &blank, .machined_mm = points});
    };
    for (const double larger : {0.005, 3.0}) {
        const auto report = compared_with(-larger, larger, 0);
        // The walls of the slot at half the height of the plate.
        EXPECT_NEAR(report.gouge.mm, 5 + larger, 1e-4) << larger;
        EXPECT_LT(report.rest.mm, 1e-6);
    }
    EXPECT_NEAR(compared_with(0, 0, 45).rest.mm, 45, 1e-4);
}

// A cut that ends at a face of the blank leaves a skin there: no material, whatever rounding says.
TEST(NearestDeviation, a_skin_without_a_thickness_is_no_rest_but_a_thin_wall_is) {
    const auto designed = design_of(prism({{0, 0}, {40, 0}, {40, 10}, {0, 10}}, {{0, 1, 2}, {0, 2, 3}}));
    const auto rest_beside = [&](double cut_to) {
        auto machined = box_field({{0, 0, 0}, {40, kLength, 40}});
        machined.carve(std::make_unique<field::BoxShape>(Box3{{-1, -1, 10}, {cut_to, 41, 41}}));
        return compared(machined, designed, 0.5).rest.mm;
    };
    for (const double off : {-1e-9, 0.0, 1e-9}) EXPECT_LT(rest_beside(40 + off), 1e-6) << off;
    EXPECT_NEAR(rest_beside(39.99), 30, 0.01);
}

// A mesh of the machined part itself, with a corner on its top moved along the top beyond its neighbours: the
// triangles there fold over each other and show the wrong side, but no point of them is off the part.
TEST(NearestDeviation, folds_of_a_designs_mesh_are_no_deviation) {
    TriangleMesh mesh = prism({{0, 0}, {40, 0}, {40, 10}, {30, 10}, {20, 10}, {10, 10}, {0, 10}},
                              {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}});
    mesh.positions[4][0] = 36;
    mesh.positions[11][0] = 3;
    const auto machined = box_field({{0, 0, 0}, {40, kLength, 10}});
    const auto designed = design_of(mesh);
    const auto report = compared(machined, designed, 0.3);
    EXPECT_LT(report.gouge.mm, 1e-6);
    EXPECT_LT(report.rest.mm, 1e-6);
    EXPECT_LT(designed.signed_distance_mm({31, 20, 5}), 0);
    EXPECT_GT(designed.signed_distance_mm({31, 20, 12}), 0);
}

// Two boxes of which one is turned. The search looks at a lattice of points: its best is a bound from below,
// and within the diagonal of a lattice cell of the largest distance. Middles of walls are found by samples
// 0.2 mm apart.
RC_GTEST_PROP(NearestDeviation, rest_and_gouge_of_boxes_are_those_of_the_worst_point, ()) {
    const auto between = [](double low, double high) {
        return low + (high - low) * 1e-3 * *rc::gen::inRange(0, 1001);
    };
    const Vec3 size{between(2, 12), between(2, 12), between(2, 12)};
    const Vec3 half{between(1, 6), between(1, 6), between(1, 6)};
    const Vec3 centre{between(0, 12), between(0, 12), between(0, 12)};
    const Vec3 z = normalized(Vec3{between(-1, 1), between(-1, 1), between(-1, 1)}, {0, 0, 1});
    const Vec3 x = any_perpendicular(z), y = cross(z, x);
    const auto to_design = [&](Vec3 p) {
        const Vec3 q{std::abs(dot(p - centre, x)) - half.x, std::abs(dot(p - centre, y)) - half.y,
                     std::abs(dot(p - centre, z)) - half.z};
        const double inside = std::min(0.0, std::max({q.x, q.y, q.z}));
        return inside + std::hypot(std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0));
    };
    TriangleMesh mesh = prism({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {{0, 1, 2}, {0, 2, 3}});
    for (Point3f& p : mesh.positions) {
        const double along = p[1] > 0 ? 1 : -1;
        const Vec3 at = centre + static_cast<double>(p[0]) * half.x * x + along * half.y * y +
                        static_cast<double>(p[2]) * half.z * z;
        p = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
    }
    const Box3 box{{0, 0, 0}, size};
    const auto machined = box_field(box);
    constexpr double kStep = 0.25, kOff = 1.7321 * kStep;
    Box3 all = bounds(mesh);
    all.include(box);
    double rest = 0, gouge = 0;
    for (double a = all.min.x + 1e-3; a <= all.max.x; a += kStep) {
        for (double b = all.min.y + 1e-3; b <= all.max.y; b += kStep) {
            for (double c = all.min.z + 1e-3; c <= all.max.z; c += kStep) {
                const Vec3 p{a, b, c};
                const bool in = box.contains(p);
                const double d = to_design(p);
                if (in && d > 0) rest = std::max(rest, d);
                if (!in && d < 0) gouge = std::max(gouge, -d);
            }
        }
    }
    const auto report = compared(machined, design_of(mesh), 0.2);
    RC_ASSERT(report.rest.mm > rest - 1e-4);
    RC_ASSERT(report.rest.mm < rest + kOff + 1e-4);
    RC_ASSERT(report.gouge.mm > gouge - 0.02);
    RC_ASSERT(report.gouge.mm < gouge + kOff + 1e-4);
}

}  // namespace
}  // namespace tribo::surface
