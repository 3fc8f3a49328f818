// SPDX-License-Identifier: MIT
// Rest, gouges and scallops of cuts that have closed forms.
#include "surface/deviation.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <rapidcheck/gtest.h>
#include <thread>

#include "field/shape/box_shape.hpp"
#include "grooves.hpp"
#include "surface/height.hpp"

namespace tribo::surface {
namespace {

using test::Grooves;
using test::rectangle;
using test::row;

constexpr double kRadius = 4, kSidestep = 2;
const double kCusp = kRadius - std::sqrt(kRadius * kRadius - kSidestep * kSidestep / 4);  // 0.127 mm

DesignedSurface surface_of(const TriangleMesh& mesh) {
    auto made = DesignedSurface::make(mesh);
    EXPECT_TRUE(made.has_value());
    return std::move(*made);
}

TEST(Height, is_the_way_to_the_border_up_or_down) {
    const Grooves field(3, kRadius, row(5, kSidestep, 8));
    EXPECT_NEAR(*height_over(field, {0, 6, 0}, {0, 0, 1}, 10), kCusp, 1e-6);
    EXPECT_NEAR(*height_over(field, {0, 5, 0}, {0, 0, 1}, 10), 0, 1e-6);
    EXPECT_NEAR(*height_over(field, {0, 6, 1}, {0, 0, 1}, 10), kCusp - 1, 1e-6);
    EXPECT_NEAR(*height_over(field, {0, -10, 0}, {0, 0, 1}, 10), 3, 1e-6);
    EXPECT_EQ(height_over(field, {0, -10, 0}, {0, 0, 1}, 2), std::nullopt);
    EXPECT_EQ(height_over(field, {0, 0, 9}, {0, 0, 1}, 2), std::nullopt);
}

TEST(Height, goes_on_where_the_field_clamps_and_slants) {
    struct Clamped : contact::DistanceField {
        double distance_mm(Vec3 p) const override {
            return std::clamp((p.z - 0.3 * p.x) / std::sqrt(1.09), -0.2, 0.2);
        }
        Vec3 normal(Vec3) const override { return {0, 0, 1}; }
    } field;
    EXPECT_NEAR(*height_over(field, {10, 0, -5}, {0, 0, 1}, 20), 8, 1e-6);
    EXPECT_NEAR(*height_over(field, {10, 0, 9}, {0, 0, 1}, 20), -6, 1e-6);
}

TEST(Deviation, passes_over_a_plane_leave_their_cusps_as_scallop_and_rest) {
    const Grooves field(3, kRadius, row(5, kSidestep, 8));  // bottoms at y = 5 ... 19
    const auto report = compare(field, surface_of(rectangle(0, 20, 5, 19)), {.spacing_mm = 0.2});
    EXPECT_NEAR(report.scallop.mm, kCusp, 1e-5);
    EXPECT_NEAR(report.rest.mm, kCusp, 1e-5);
    EXPECT_EQ(std::fmod(std::round(report.scallop.at_mm.y * 1e4), 2e4), 0);  // in the middle: y even
    EXPECT_LT(report.gouge.mm, 1e-6);
    const double half = kSidestep / 2;
    const double under_arc =
        half * std::sqrt(kRadius * kRadius - half * half) + kRadius * kRadius * std::asin(half / kRadius);
    const double mean = kRadius - under_arc / kSidestep;
    EXPECT_NEAR(report.mean_mm, mean, 0.01 * mean);
    EXPECT_NEAR(report.rest_mm3, mean * 20 * 14, 0.01 * mean * 20 * 14);
    EXPECT_NEAR(report.measured_mm2, 280, 1e-3);
    EXPECT_EQ(report.unmeasured_mm2, 0);
    const double quarter = kSidestep / 4;
    EXPECT_NEAR(report.p50_mm, kRadius - std::sqrt(kRadius * kRadius - quarter * quarter), 5e-3);
    const double touched = std::sqrt(2 * kRadius * 0.01 - 1e-4);
    EXPECT_NEAR(report.touched_share, touched / half, 0.03);
    EXPECT_NEAR(std::accumulate(report.histogram.shares.begin(), report.histogram.shares.end(), 0.0), 1,
                1e-9);
}

TEST(Deviation, scallops_finer_than_the_touch_tolerance_are_still_seen) {
    const Grooves field(3, kRadius, row(5, 0.4, 36));
    const auto report = compare(field, surface_of(rectangle(0, 4, 5, 19)), {.spacing_mm = 0.04});
    EXPECT_NEAR(report.scallop.mm, kRadius - std::sqrt(kRadius * kRadius - 0.04), 1e-6);
}

TEST(Deviation, material_never_reached_is_rest_but_no_scallop) {
    // Two fields of passes with a wall between them, and nothing cut at y < 1.
    const field::BoxShape blank(Box3{{-10, -10, -20}, {40, 40, 3}});
    auto passes = row(5, kSidestep, 4);
    const auto more = row(20, kSidestep, 4);
    passes.insert(passes.end(), more.begin(), more.end());
    const auto report = compare(Grooves(3, kRadius, passes), surface_of(rectangle(0, 20, 0, 24)),
                                {.spacing_mm = 0.2, .pass_width_mm = 2 * kRadius, .blank = &blank});
    EXPECT_NEAR(report.rest.mm, 3, 1e-6);
    EXPECT_NEAR(report.scallop.mm, kCusp, 1e-5);
}

TEST(Deviation, strips_of_the_blank_between_passes_are_no_scallops) {
    const double top = 0.05;  // lower than the cusps would be: strips 0.74 mm wide stay as they were
    const field::BoxShape blank(Box3{{-10, -10, -20}, {40, 40, top}});
    const Grooves field(top, kRadius, row(5, kSidestep, 8));
    const DeviationOptions options{.spacing_mm = 0.1, .pass_width_mm = 2 * kRadius, .blank = &blank};
    const auto report = compare(field, surface_of(rectangle(0, 10, 5, 19)), options);
    EXPECT_NEAR(report.rest.mm, top, 1e-6);
    EXPECT_EQ(report.scallop.mm, 0);
}

TEST(Deviation, a_corner_that_no_pass_can_reach_is_rest_but_no_scallop) {
    // Two walls that meet at a right angle, and the round that a cutter leaves between them.
    struct Round : contact::DistanceField {
        double distance_mm(Vec3 p) const override {
            return kRadius - length(Vec3{std::max(kRadius - p.x, 0.0), std::max(kRadius - p.y, 0.0), 0});
        }
        Vec3 normal(Vec3) const override { return {0, 0, 1}; }
    } field;
    TriangleMesh walls;
    walls.positions = {{0, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}, {0, 10, 0}, {0, 10, 5}};
    walls.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 5, 3}, {0, 4, 5}};
    for (const double spacing : {0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5}) {
        const auto report = compare(field, surface_of(walls), {.spacing_mm = spacing});
        EXPECT_NEAR(report.rest.mm, kRadius * (1 - std::sqrt(0.5)), 1e-4) << spacing;
        EXPECT_EQ(report.scallop.mm, 0) << spacing;
        // The walls, and where the round is at most 0.01 mm high.
        const double low = std::sqrt(2 * kRadius * 0.01 - 1e-4);
        EXPECT_NEAR(report.touched_share, (10 - kRadius + low) / 10, 0.03) << spacing;
    }
}

TEST(Deviation, a_pass_set_too_deep_gouges_by_as_much) {
    auto passes = row(5, kSidestep, 8);
    passes[3].bottom = -0.2;
    const Grooves field(3, kRadius, passes);
    const auto report = compare(field, surface_of(rectangle(0, 20, 5, 19)), {.spacing_mm = 0.3});
    EXPECT_NEAR(report.gouge.mm, 0.2, 1e-6);
    EXPECT_NEAR(report.gouge.at_mm.y, 11, 1e-3);
    EXPECT_NEAR(report.scallop.mm, kCusp, 1e-5);
    EXPECT_LT(report.p1_mm, -0.15);
}

TEST(Deviation, an_allowance_left_everywhere_has_no_scallop) {
    auto passes = row(5, kSidestep, 8);
    for (auto& pass : passes) pass.bottom = 0.5;
    const auto report =
        compare(Grooves(3, kRadius, passes), surface_of(rectangle(0, 20, 5, 19)), {.spacing_mm = 0.3});
    EXPECT_EQ(report.scallop.mm, 0);
    EXPECT_NEAR(report.rest.mm, 0.5 + kCusp, 1e-5);
    EXPECT_EQ(report.touched_share, 0);
}

TEST(Deviation, what_the_blank_did_not_have_is_not_gouged) {
    // The design is larger than the blank (x < 20), and the cut went right through it at y > 10.
    struct Rest : contact::DistanceField {
        double distance_mm(Vec3 p) const override { return std::max({p.z, -5 - p.z, p.x - 20, p.y - 10}); }
        Vec3 normal(Vec3) const override { return {0, 0, 1}; }
    } field;
    const field::BoxShape blank(Box3{{-1, -1, -5}, {20, 31, 0}});
    const auto report =
        compare(field, surface_of(rectangle(0, 30, 0, 30)), {.spacing_mm = 0.5, .blank = &blank});
    EXPECT_NEAR(report.unmeasured_mm2, 300, 20);
    EXPECT_NEAR(report.gouge.mm, 5, 2e-3);
    EXPECT_NEAR(report.gouge_mm3, 20 * 20 * 5, 60);
    const auto blind = compare(field, surface_of(rectangle(0, 30, 0, 30)), {.spacing_mm = 0.5});
    EXPECT_LT(blind.gouge.mm, 1e-6);
}

TEST(Deviation, threads_change_nothing) {
    const Grooves field(3, kRadius, row(5, kSidestep, 8));
    const auto designed = surface_of(rectangle(0, 20, 0, 24));
    const ParallelFor backwards = [](std::size_t n, const std::function<void(std::size_t)>& body) {
        std::thread other([&] {
            for (std::size_t i = 1; i < n; i += 2) body(i);
        });
        for (std::size_t i = (n + 1) / 2; i-- > 0;) body(2 * i);
        other.join();
    };
    const auto a = compare(field, designed, {.spacing_mm = 0.3}),
               b = compare(field, designed, {.spacing_mm = 0.3}, backwards);
    EXPECT_EQ(a.heights_mm, b.heights_mm);
    EXPECT_EQ(a.scallop.mm, b.scallop.mm);
    EXPECT_EQ(a.rest.at_mm, b.rest.at_mm);
    EXPECT_EQ(a.mean_mm, b.mean_mm);
}

TEST(Deviation, positions_get_their_signed_distance_to_the_design) {
    const auto designed = surface_of(rectangle(0, 10, 0, 10));
    const TriangleMesh machined{{{1, 1, 0.25F}, {2, 2, -0.5F}, {3, 3, 0}}, {}, {}};
    EXPECT_EQ(deviations_of(machined, designed), (std::vector<float>{0.25F, -0.5F, 0}));
}

// Over faces, edges and corners; from the reach on there is none.
TEST(Deviation, of_a_position_is_looked_for_within_a_reach) {
    const auto designed = surface_of(rectangle(0, 10, 0, 10));
    const TriangleMesh machined{
        {{5, 5, 9}, {5, 5, 0.25F}, {-0.3F, 5, 0.4F}, {5, 5, -3.01F}, {10.2F, 10.1F, 0.2F}, {5, 5, -2.99F}},
        {},
        {}};
    const std::vector<float> found = deviations_of(machined, designed, serial_for, 3);
    ASSERT_EQ(found.size(), 6u);
    EXPECT_TRUE(std::isnan(found[0]));
    EXPECT_FLOAT_EQ(found[1], 0.25F);
    EXPECT_FLOAT_EQ(found[2], 0.5F);
    EXPECT_TRUE(std::isnan(found[3]));
    EXPECT_FLOAT_EQ(found[4], 0.3F);
    EXPECT_FLOAT_EQ(found[5], -2.99F);
}

RC_GTEST_PROP(Deviation, within_a_reach_is_the_same_as_without, (int a, int b, int c)) {
    const auto in = [](int n, double low, double high) {
        return low + (high - low) * (static_cast<unsigned>(n) % 1009) / 1009.0;
    };
    const auto designed = surface_of(rectangle(0, 10, 0, 10));
    const TriangleMesh one{{{static_cast<float>(in(a, -5, 15)), static_cast<float>(in(b, -5, 15)),
                             static_cast<float>(in(c, -5, 5))}},
                           {},
                           {}};
    const float anywhere = deviations_of(one, designed).front();
    const float near = deviations_of(one, designed, serial_for, 3).front();
    if (std::abs(anywhere) < 3) {
        RC_ASSERT(near == anywhere);
    } else {
        RC_ASSERT(std::isnan(near));
    }
}

}  // namespace
}  // namespace tribo::surface
