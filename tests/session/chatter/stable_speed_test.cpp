// SPDX-License-Identifier: MIT
#include "session/chatter/stable_speed.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "session/audit/audited_cut.hpp"
#include "session/kept_rows.hpp"

namespace tribo::session {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

// The slot of the benchmark of the literature (Insperger and Stepan 2004) with its mode along the feed: 1
// mm deep it chatters at 8,000 rpm and not at 9,000.
MillSetup bending_slot(double rpm, double depth_mm, bool bends_across = false) {
    milling::Cutter cutter{.number = 3, .diameter_mm = 10, .flutes = 2, .helix_deg = 0, .length_mm = 20};
    MillSetup setup = block_setup(Box3{{0, -20, -10}, {30, 20, 0}}, cutter, 0.5);
    setup.coefficients = {.ktc = 600, .krc = 200};
    motion::Move cut = straight_cut({-10, 0, -depth_mm}, {40, 0, -depth_mm}, 0.2 * rpm);
    cut.line = 7;
    add_cut(setup, cut, rpm);
    constexpr double kStiffness = 1340;  // N/mm
    std::vector<dynamics::Mode> modes{{{1, 0, 0}, 922, 0.011, kStiffness}};
    if (bends_across) modes.push_back({{0, 1, 0}, 922, 0.011, kStiffness});
    setup.modes_of_cutter = {modes};
    return setup;
}

std::vector<StableSpeed> found(MillSetup setup, double most_rpm = kNoBound) {
    MillSession session(std::move(setup), serial_for);
    StableSpeedSearch search(session.setup());
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce&) {
        if (row.engagement.bands.empty()) return;
        if (const auto stability = stability_of(row, session.setup())) search.add(row, stability->multiplier);
    };
    session.run(sinks);
    return search.find({most_rpm}, serial_for);
}

TEST(StableSpeed, leaves_the_speed_of_a_cut_that_does_not_chatter) {
    const auto speeds = found(bending_slot(9000, 0.2));
    ASSERT_EQ(speeds.size(), 1u);
    EXPECT_TRUE(speeds[0].is_stable());
    EXPECT_EQ(speeds[0].new_rpm, speeds[0].old_rpm);
    EXPECT_FALSE(speeds[0].is_better());
}

TEST(StableSpeed, is_found_in_a_pocket_between_lobes) {
    const auto speeds = found(bending_slot(8000, 1));
    ASSERT_EQ(speeds.size(), 1u);
    const StableSpeed& speed = speeds[0];
    EXPECT_EQ(speed.line, 7);
    EXPECT_GT(speed.old_multiplier, 1);
    ASSERT_TRUE(speed.is_better());
    EXPECT_TRUE(speed.is_stable());
    // Asked again, it stays.
    const auto again = found(bending_slot(speed.new_rpm, 1));
    EXPECT_TRUE(again[0].is_stable());
    EXPECT_EQ(again[0].new_rpm, again[0].old_rpm);
}

TEST(StableSpeed, keeps_to_the_bound) {
    const StableSpeed free = found(bending_slot(8000, 1))[0];
    ASSERT_GT(free.new_rpm, 8200);
    const StableSpeed bound = found(bending_slot(8000, 1), 8200)[0];
    EXPECT_LE(bound.new_rpm, 8200);
    EXPECT_EQ(bound.most_rpm, 8200);
    // A tool that is faster already is not called too fast, and gets no faster.
    EXPECT_LE(found(bending_slot(8000, 1), 5000)[0].new_rpm, 8000);
}

TEST(StableSpeed, says_where_no_speed_is_stable) {
    const auto speeds = found(bending_slot(8000, 9, true));
    ASSERT_EQ(speeds.size(), 1u);
    EXPECT_FALSE(speeds[0].is_stable());
    EXPECT_FALSE(speeds[0].is_better());
}

}  // namespace
}  // namespace tribo::session
