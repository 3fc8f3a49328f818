// SPDX-License-Identifier: MIT
// Engagement measured on stock of known shape, against the angles and areas that geometry gives.
#include "milling/engagement/engagement_probe.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "base/math.hpp"
#include "field/shape/box_shape.hpp"

namespace tribo::milling {
namespace {

using std::numbers::pi;

Box3 box(Vec3 a, Vec3 b) {
    return {a, b};
}

// A block of 40 x 30 x 10 mm below z = 0 of which everything behind x = 20 is gone.
field::CarvedField block(double cell) {
    field::CarvedField f(std::make_unique<field::BoxShape>(box({0, 0, -10}, {40, 30, 0})), cell);
    f.carve(std::make_unique<field::BoxShape>(box({-5, -5, -15}, {20, 40, 5})));
    return f;
}

Cutter flat(double diameter) {
    Cutter c;
    c.diameter_mm = diameter;
    return c;
}

CutPose at(Vec3 tip) {
    return {tip, tool_frame({0, 0, 1}, {1, 0, 0}, {1, 0, 0}), {.across_mm = 1}};
}

TEST(EngagementProbe, sees_a_slot_from_side_to_side) {
    const auto f = block(0.25);
    EngagementProbe probe(flat(10));
    Engagement e;
    probe.measure(f, at({20, 15, -3}), e);
    ASSERT_EQ(e.bands.size(), 1u);
    EXPECT_DOUBLE_EQ(e.bands[0].entry_rad, 0);
    EXPECT_DOUBLE_EQ(e.bands[0].exit_rad, pi);
    EXPECT_NEAR(e.bands[0].z0_mm, 0, 1e-9);
    EXPECT_NEAR(e.bands[0].z1_mm, 3, 0.01);
    EXPECT_TRUE(e.bottom.empty());
}

RC_GTEST_PROP(EngagementProbe, finds_the_angle_of_any_radial_immersion, ()) {
    const double offset = 0.01 * *rc::gen::inRange(-450, 450), radius = 5;
    auto f = block(0.25);
    f.carve(std::make_unique<field::BoxShape>(box({-5, 15 + offset, -15}, {50, 40, 5})));
    EngagementProbe probe(flat(2 * radius));
    Engagement e;
    probe.measure(f, at({20, 15, -3}), e);
    RC_ASSERT(e.bands.size() == 1u);
    RC_ASSERT(std::abs(e.bands[0].entry_rad - std::acos(offset / radius)) < 0.0025);
    RC_ASSERT(e.bands[0].exit_rad == math::kPi);
}

TEST(EngagementProbe, finds_the_height_of_a_step) {
    auto f = block(0.25);
    f.carve(std::make_unique<field::BoxShape>(box({-5, -5, -1}, {50, 15, 5})));
    EngagementProbe probe(flat(10));
    Engagement e;
    probe.measure(f, at({20, 15, -3}), e);
    EXPECT_NEAR(chip_mm3(flat(10), e, {1, 0}), 5 * (3 + 2), 0.01 * 25);
    double top_right = 0;
    for (const EngagementBand& b : e.bands) {
        if (b.exit_rad > 3) top_right = std::max(top_right, b.z1_mm);
    }
    EXPECT_NEAR(top_right, 2, 0.02);
}

TEST(EngagementProbe, sees_two_walls_apart) {
    auto f = block(0.25);
    f.carve(std::make_unique<field::BoxShape>(box({-5, 12, -15}, {50, 18, 5})));
    EngagementProbe probe(flat(10));
    Engagement e;
    probe.measure(f, at({20, 15, -3}), e);
    ASSERT_EQ(e.bands.size(), 2u);
    EXPECT_NEAR(e.bands[0].exit_rad, std::acos(0.6), 0.0025);
    EXPECT_NEAR(e.bands[1].entry_rad, pi - std::acos(0.6), 0.0025);
}

TEST(EngagementProbe, gives_the_chip_area_of_a_ball_slot) {
    const auto f = block(0.1);
    Cutter ball = flat(8);
    ball.kind = CutterKind::ball;
    for (const double depth : {0.5, 1.5, 4.0, 6.0}) {
        EngagementProbe probe(ball);
        Engagement e;
        probe.measure(f, at({20, 15, -depth}), e);
        const double round = std::min(depth, 4.0), half = std::acos(1 - round / 4);
        const double section = 16 * (half - std::sin(half) * std::cos(half)) + 8 * (depth - round);
        EXPECT_NEAR(chip_mm3(ball, e, {1, 0}) / section, 1, 0.005) << depth;
    }
}

TEST(EngagementProbe, gives_the_whole_bottom_of_a_plunge) {
    const field::CarvedField f(std::make_unique<field::BoxShape>(box({0, 0, -10}, {40, 30, 0})), 0.25);
    EngagementProbe probe(flat(10));
    Engagement e;
    CutPose pose = at({20, 15, -1e-3});
    pose.travel = {0, 1};
    probe.measure(f, pose, e);
    EXPECT_NEAR(chip_mm3(flat(10), e, {0, 1}), pi * 25, 1e-9);
    pose.tip_mm.x = 0;  // half of it over the edge
    probe.measure(f, pose, e);
    EXPECT_NEAR(chip_mm3(flat(10), e, {0, 1}), pi * 25 / 2, 0.01 * 25);
}

TEST(EngagementProbe, gives_the_area_of_a_plunging_ball) {
    const field::CarvedField f(std::make_unique<field::BoxShape>(box({0, 0, -10}, {40, 30, 0})), 0.1);
    Cutter ball = flat(8);
    ball.kind = CutterKind::ball;
    EngagementProbe probe(ball);
    Engagement e;
    CutPose pose = at({20, 15, -2});
    pose.travel = {0, 1};
    probe.measure(f, pose, e);
    const double r = std::sqrt(16.0 - 4.0);
    EXPECT_NEAR(chip_mm3(ball, e, {0, 1}) / (pi * r * r), 1, 0.01);
}

TEST(EngagementProbe, sees_nothing_where_it_cut_before) {
    auto f = block(0.25);
    f.carve(std::make_unique<field::BoxShape>(box({-5, -5, -3}, {50, 40, 5})));
    EngagementProbe probe(flat(10));
    Engagement e;
    probe.measure(f, at({20, 15, -3}), e);
    EXPECT_TRUE(e.empty());
}

TEST(EngagementProbe, works_in_any_orientation) {
    // The slot of the first test, everything turned by 90 degrees about x: the tool lies along -y.
    field::CarvedField f(std::make_unique<field::BoxShape>(box({0, 0, 0}, {40, 10, 30})), 0.25);
    f.carve(std::make_unique<field::BoxShape>(box({-5, -5, -5}, {20, 15, 40})));
    EngagementProbe probe(flat(10));
    Engagement e;
    const CutPose pose{{20, 7, 15}, tool_frame({0, 1, 0}, {1, 0, 0}, {1, 0, 0}), {1, 0}};
    probe.measure(f, pose, e);
    ASSERT_EQ(e.bands.size(), 1u);
    EXPECT_NEAR(e.bands[0].z1_mm, 3, 0.01);
    EXPECT_NEAR(e.bands[0].exit_rad - e.bands[0].entry_rad, pi, 1e-9);
}

TEST(ToolFrame, keeps_the_last_feed_direction_in_a_plunge) {
    const ToolFrame f = tool_frame({0, 0, 1}, {0, 0, -1}, {0.6, 0.8, 0});
    EXPECT_NEAR(f.x.x, 0.6, 1e-12);
    EXPECT_NEAR(f.y.x, -0.8, 1e-12);
}

}  // namespace
}  // namespace tribo::milling
