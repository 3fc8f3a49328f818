// SPDX-License-Identifier: MIT
#include "motion/path/summary.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "motion/program_summary.hpp"

namespace tribo::motion {
namespace {

using std::numbers::pi;
using testing::summary_of;

Move straight(MoveKind kind, Vec3 from, Vec3 to, double feed, int tool) {
    Move move;
    move.kind = kind;
    move.start.tip_mm = from;
    move.end.tip_mm = to;
    move.feed_mm_per_min = feed;
    move.tool = tool;
    return move;
}

TEST(ProgramSummary, AddsUpAProgramDoneByHand) {
    Program program;
    program.moves.push_back(straight(MoveKind::rapid, {0, 0, 100}, {0, 0, 0}, 0, 4));
    program.moves.push_back(straight(MoveKind::feed, {0, 0, 0}, {30, 0, 0}, 300, 4));
    Move arc = straight(MoveKind::feed, {30, 0, 0}, {30, 20, 0}, 600, 2);
    arc.arc = Arc{{30, 10, 0}, {0, 0, 1}, pi};  // bulges to x = 40
    arc.spindle_rpm = 5000;
    program.moves.push_back(arc);
    Move timed = straight(MoveKind::feed, {30, 20, 0}, {0, 20, 0}, 100, 4);
    timed.duration_s = 9;
    timed.spindle_rpm = 4000;
    program.moves.push_back(timed);
    Move dwell = straight(MoveKind::dwell, {0, 20, 0}, {0, 20, 0}, 0, 4);
    dwell.duration_s = 2.5;
    program.moves.push_back(dwell);

    const ProgramSummary summary = summary_of(program, 6000);
    EXPECT_EQ(summary.moves, 4U);
    EXPECT_EQ(summary.feed_moves, 3U);
    EXPECT_NEAR(summary.path_mm, 60 + 10 * pi, 1e-12);
    EXPECT_NEAR(summary.rapid_mm, 100, 1e-12);
    EXPECT_NEAR(summary.rapid_s, 1, 1e-12);
    EXPECT_NEAR(summary.feed_s, 6 + pi + 9, 1e-12);
    EXPECT_EQ(summary.dwell_s, 2.5);
    EXPECT_EQ(summary.tools, (std::vector<int>{2, 4}));
    EXPECT_EQ(summary.feed_mm_per_min.least, 100);
    EXPECT_EQ(summary.feed_mm_per_min.most, 600);
    EXPECT_EQ(summary.spindle_rpm.least, 4000);
    EXPECT_EQ(summary.spindle_rpm.most, 5000);
    EXPECT_FALSE(summary.tilted);
    // The rapid's start at z = 100 does not count.
    EXPECT_EQ(summary.bounds_mm.min, (Vec3{0, 0, 0}));
    EXPECT_NEAR(summary.bounds_mm.max.x, 40, 1e-12);
    EXPECT_EQ(summary.bounds_mm.max.y, 20);
    EXPECT_EQ(summary.bounds_mm.max.z, 0);
}

TEST(ProgramSummary, SaysWhenTheToolTiltsAndWhenAMachineIsNeeded) {
    Program program;
    program.moves.push_back(straight(MoveKind::feed, {0, 0, 0}, {1, 0, 0}, 100, 0));
    EXPECT_FALSE(summary_of(program).tilted);
    program.moves[0].end.axis = {0, 0.6, 0.8};
    program.has_rotary_words = true;
    EXPECT_TRUE(summary_of(program).tilted);
    EXPECT_NEAR(summary_of(program).tilt_rad, std::acos(0.8), 1e-12);
}

TEST(ProgramSummary, OfNothingIsEmpty) {
    const ProgramSummary summary = summary_of({});
    EXPECT_EQ(summary.moves, 0U);
    EXPECT_TRUE(summary.bounds_mm.empty());
    EXPECT_TRUE(summary.tools.empty());
}

}  // namespace
}  // namespace tribo::motion
