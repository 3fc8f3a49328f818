// SPDX-License-Identifier: MIT
// Feeds against closed forms: one straight tooth, so that the force at the rotation phi is
// depth (ktc f sin phi + kte).
#include "session/feed/feed_plan.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "session/audit/audited_cut.hpp"

namespace tribo::session {
namespace {

constexpr double kPi = 3.14159265358979;

std::vector<BlockFeed> planned(MillSetup setup, const job::JobLimits& limits, FeedPlanOptions options = {}) {
    job::Job job;
    job.limits = limits;
    const LoadModel model(setup, cut_limits(job, setup));
    MillSession session(std::move(setup), serial_for);
    FeedPlan plan(model, session, options);
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) { plan.add(row, force); };
    session.run(sinks);
    return plan.finish();
}

// Wide limits, so that the force alone decides.
job::JobLimits force_alone(double force_n) {
    return {.force_n = force_n, .stress_n_per_mm2 = 1e4, .chip_min_mm = 1e-6, .chip_max_mm = 5};
}

TEST(FeedPlan, solves_a_slot_in_closed_form) {
    const auto blocks = planned(slot_setup(), force_alone(120));
    ASSERT_EQ(blocks.size(), 1u);
    // 120 N = 1000 N/mm2 2 mm f: f = 0.06 mm, at 6000 rpm.
    EXPECT_NEAR(blocks[0].new_mm_per_min, 360, 0.002 * 360);
    EXPECT_LE(blocks[0].new_mm_per_min, 360 * 1.001);
    EXPECT_EQ(blocks[0].reason, FeedReason::load);
    EXPECT_NEAR(blocks[0].ratio, 200 / 120.0, 1e-3);
    EXPECT_NEAR(planned(slot_setup(), force_alone(800))[0].new_mm_per_min, 2400, 0.002 * 2400);
}

TEST(FeedPlan, counts_the_force_of_the_edge) {
    MillSetup setup = slot_setup();
    setup.coefficients.kte = 20;  // 40 N on 2 mm
    EXPECT_NEAR(planned(std::move(setup), force_alone(120))[0].new_mm_per_min, 240, 0.002 * 240);
    setup = slot_setup();
    setup.coefficients.kte = 70;
    const auto edge = planned(std::move(setup), force_alone(120));
    EXPECT_EQ(edge[0].reason, FeedReason::edge);
    EXPECT_EQ(edge[0].new_mm_per_min, 600);
    EXPECT_TRUE(may_stay_over(edge[0].reason));
}

TEST(FeedPlan, counts_run_out) {
    // Two teeth, one stands out by 2 * 0.02 mm: while f > 0.04 the chips are f + 0.04 and f - 0.04.
    MillSetup setup = slot_setup(1200);
    setup.cutters[0].flutes = 2;
    setup.cutters[0].runout_mm = 0.02;
    EXPECT_NEAR(planned(std::move(setup), force_alone(200))[0].new_mm_per_min, 0.06 * 12'000, 0.01 * 720);
}

TEST(FeedPlan, stays_within_chip_and_machine) {
    job::JobLimits limits = force_alone(1e5);
    limits.chip_max_mm = 0.25;
    auto blocks = planned(slot_setup(), limits);
    EXPECT_NEAR(blocks[0].new_mm_per_min, 1500, 1e-6);
    EXPECT_EQ(blocks[0].reason, FeedReason::thick_chip);
    blocks = planned(slot_setup(), limits, {.most_mm_per_min = 1000});
    EXPECT_NEAR(blocks[0].new_mm_per_min, 1000, 1e-6);
    EXPECT_EQ(blocks[0].reason, FeedReason::machine);
    limits = force_alone(20);  // 0.01 mm
    limits.chip_min_mm = 0.03;
    blocks = planned(slot_setup(), limits);
    EXPECT_NEAR(blocks[0].new_mm_per_min, 180, 1e-6);
    EXPECT_EQ(blocks[0].reason, FeedReason::thin_chip);
}

TEST(FeedPlan, respects_the_worst_end_of_the_band_if_it_shall_be_sure) {
    MillSetup setup = slot_setup();
    setup.force_low_factor = 0.5;
    setup.force_high_factor = 2;
    EXPECT_NEAR(planned(std::move(setup), force_alone(120), {.sure = true})[0].new_mm_per_min, 180, 0.4);
}

// A wall with a radial depth of 2 mm, then the inner corner where the next wall begins.
TEST(FeedPlan, slows_down_in_an_inner_corner_as_its_engagement_asks_for) {
    MillSetup setup = slot_setup();
    setup.engagement.reset();
    setup.moves.clear();
    setup.cutter_of_move.clear();
    setup.rpm_of_move.clear();
    setup.cell_mm = 0.25;
    // A pocket that is open to y = 20 is cleared first, up to x = 18 and down to y = -15.
    setup.blank = std::make_unique<field::BoxShape>(Box3{{0, -20, -2}, {30, 20, 0}});
    int line = 1;
    const auto cut = [&](const Vec3& from, const Vec3& to) {
        motion::Move move = straight_cut(from, to, 600);
        move.line = line++;
        add_cut(setup, move);
    };
    for (double y = 20; y >= -10; y -= 4) cut({-6, y, -2}, {13, y, -2});
    cut({-6, -10, -2}, {13, -10, -2});
    cut({13, -10, -2}, {13, 20, -2});
    // 2 mm of wall; from x = 9 on the rim meets the rounded corner that the clearing left, then the wall
    // ahead.
    const int wall = line;
    cut({-6, -12, -2}, {8.9, -12, -2});
    cut({8.9, -12, -2}, {15, -12, -2});
    const auto blocks = planned(std::move(setup), force_alone(60));
    double along = 0, corner = 0;
    for (const BlockFeed& block : blocks) {
        if (block.line == wall) along = block.new_mm_per_min;
        if (block.line == wall + 1) corner = block.new_mm_per_min;
    }
    // Along the wall the tooth leaves the cut at cos phi = 1 - 2 / 5; its chip there is f sin phi. In the
    // corner it passes the place straight ahead, where the chip is f.
    const double sine = std::sin(std::acos(1 - 2 / 5.0));
    const double full = 60 / (kSlotKtc * 2) * kSlotRpm;
    EXPECT_NEAR(corner, full, 0.02 * full);
    EXPECT_NEAR(along, full / sine, 0.02 * full / sine);
}

TEST(FeedPlan, asks_for_no_feed_that_a_short_block_cannot_reach) {
    MillSetup setup = slot_setup();
    setup.moves.clear();
    setup.cutter_of_move.clear();
    setup.rpm_of_move.clear();
    setup.timing.acceleration_mm_per_s2 = 100;
    const auto cut = [&](double from, double to, int line) {
        motion::Move move = straight_cut({from, 0, -2}, {to, 0, -2}, 600);
        move.line = line;
        add_cut(setup, move);
    };
    cut(0, 10, 1);
    cut(10, 11, 2);
    cut(11, 21, 3);
    // Each may run at 6000 mm/min, but the second block is 1 mm long.
    const auto blocks = planned(std::move(setup), force_alone(2000));
    ASSERT_EQ(blocks.size(), 3u);
    for (std::size_t n = 0; n + 1 < blocks.size(); ++n) {
        const double v = blocks[n].new_mm_per_min / 60, next = blocks[n + 1].new_mm_per_min / 60;
        EXPECT_LE(v * v, next * next + 2 * 100 * blocks[n].length_mm * (1 + 1e-9));
        EXPECT_LE(next * next, v * v + 2 * 100 * blocks[n + 1].length_mm * (1 + 1e-9));
    }
}

RC_GTEST_PROP(FeedSolver, finds_the_largest_feed_within_the_limit, ()) {
    const auto between = [](double low, double high) {
        return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0;
    };
    milling::Cutter cutter{.diameter_mm = between(1, 20),
                           .flutes = *rc::gen::inRange(1, 6),
                           .helix_deg = between(0, 45),
                           .length_mm = 30};
    cutter.runout_mm = *rc::gen::inRange(0, 2) * between(0, 0.02);
    MillSetup setup = block_setup(Box3{{0, 0, -5}, {5, 5, 0}}, cutter, 0.5);
    job::Job job;
    milling::CutRow row;
    const double entry = between(0, kPi), depth = between(0.1, 10);
    row.engagement.bands = {{0, depth, entry, between(entry + 0.05, kPi + 0.1)}};
    row.feed.across_mm = 0.001 * cutter.diameter_mm * between(0.1, 20);
    row.spindle_rpm = 8000;
    milling::ForceModel force(cutter, setup.coefficients);
    force.engage(row.engagement, row.feed);
    const double now = force.peaks().peak_force_n;
    job.limits.force_n = now * between(0.3, 4);
    job.limits.stress_n_per_mm2 = 1e4;
    const LoadModel model(setup, cut_limits(job, setup));
    FeedSolver solver(setup, model, false);
    const double factor = solver.largest_factor(row, solver.ratio(row, 1), 100);
    if (factor == 0) {
        // The edges alone reach the limit, as closely as it is looked for, or a tooth that begins to cut at a
        // trace of a feed.
        RC_ASSERT(std::max(solver.ratio(row, 1e-6), solver.ratio(row, 0.01)) > 1 - 2e-3);
        return;
    }
    RC_ASSERT(solver.ratio(row, factor) <= 1 + 1e-5);
    if (factor < 100) RC_ASSERT(solver.ratio(row, 1.01 * factor) > 1 - 2e-3);
}

}  // namespace
}  // namespace tribo::session
