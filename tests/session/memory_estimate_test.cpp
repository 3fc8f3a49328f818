// SPDX-License-Identifier: MIT
// What a program will take in memory against what its session takes.
#include "session/cut/memory_estimate.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "field/shape/box_shape.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/moves.hpp"

namespace tribo::session {
namespace {

double drawn(double low, double high) {
    return low + (high - low) * 1e-4 * *rc::gen::inRange(0, 10001);
}

MillSetup setup_of(const milling::Cutter& cutter, const Box3& blank, double cell_mm,
                   const std::vector<motion::ToolPose>& poses) {
    MillSetup s;
    s.cutters = {cutter};
    s.coefficients = milling::find_material("al7075-t6")->coefficients;
    s.blank = std::make_unique<field::BoxShape>(blank);
    s.blank_volume_mm3 = blank.volume();
    s.cell_mm = cell_mm;
    for (std::size_t n = 1; n < poses.size(); ++n) {
        motion::Move move;
        move.start = poses[n - 1];
        move.end = poses[n];
        move.feed_mm_per_min = 600;
        for (const motion::Move& piece : motion::to_elementary(move)) {
            s.moves.push_back(piece);
            s.cutter_of_move.push_back(0);
            s.rpm_of_move.push_back(6000);
        }
    }
    return s;
}

// Any tool on any way through any block: bricks in use, at most, counted after each twentieth of it.
RC_GTEST_PROP(MemoryEstimate, counts_the_bricks_of_any_program, ()) {
    milling::Cutter cutter;
    cutter.kind = *rc::gen::element(milling::CutterKind::flat, milling::CutterKind::ball);
    cutter.diameter_mm = *rc::gen::element(0.2, 1.0, 4.0, 12.0, 40.0);
    cutter.length_mm = cutter.diameter_mm * drawn(1, 5);
    const Vec3 size{drawn(5, 80), drawn(5, 80), drawn(2, 40)};
    const bool tilts = *rc::gen::element(false, true);
    const double depth = std::min(0.8 * size.z, 1.5 * cutter.diameter_mm);
    std::vector<motion::ToolPose> poses;
    const int count = *rc::gen::inRange(2, 7);
    for (int n = 0; n < count; ++n) {
        const Vec3 axis = tilts ? normalized(Vec3{drawn(-0.5, 0.5), drawn(-0.5, 0.5), 1}) : Vec3{0, 0, 1};
        poses.push_back({{drawn(-5, size.x + 5), drawn(-5, size.y + 5), size.z - drawn(0, depth)}, axis});
    }
    const double cell = std::max(size.x, std::max(size.y, size.z)) / drawn(40, 120);
    MillSetup setup = setup_of(cutter, {{}, size}, cell, poses);
    const double estimate = MemoryEstimate(setup, cell).cut_bricks(cell);
    MillSession session(std::move(setup), serial_for);
    double most = 0;
    constexpr int kLooks = 20;
    for (int n = 1; n <= kLooks; ++n) {
        RC_ASSERT(session.run_to(session.duration_s() * n / kLooks, {}));
        most = std::max(most, static_cast<double>(session.stock().bricks_in_use()));
    }
    if (most < 100) return;
    RC_ASSERT(estimate > 0.5 * most);
    RC_ASSERT(estimate <= 2 * most);
}

// One move carries away all above a plane. What it passes on its way never has bricks.
TEST(MemoryEstimate, counts_no_brick_that_the_same_move_carries_away) {
    milling::Cutter cutter;
    cutter.diameter_mm = 40;
    cutter.length_mm = 40;
    const Box3 blank{{}, {15, 11, 13.5}};
    const std::vector<motion::ToolPose> poses{{{7, 5, 14}, {0, 0, 1}}, {{7, 5, 2.8}, {0, 0, 1}}};
    const double cell = 0.2;
    MillSetup setup = setup_of(cutter, blank, cell, poses);
    const double estimate = MemoryEstimate(setup, cell).cut_bricks(cell);
    MillSession session(std::move(setup), serial_for);
    ASSERT_TRUE(session.run({}));
    EXPECT_EQ(session.stock().bricks_in_use(), 12u * 9u);
    EXPECT_EQ(estimate, 12 * 9);
}

// Engraving in a large plate takes what the engraving takes, not what the plate could; a coarser look at a
// long program finds as many bricks as a look brick by brick.
TEST(MemoryEstimate, follows_the_tool_and_not_the_blank) {
    milling::Cutter cutter;
    cutter.diameter_mm = 0.1;
    cutter.length_mm = 0.3;
    const std::vector<motion::ToolPose> poses{{{50, 50, -0.05}, {0, 0, 1}}, {{52, 50, -0.05}, {0, 0, 1}}};
    const Box3 blank{{0, 0, -20}, {100, 100, 0}};
    const MemoryEstimate estimate(setup_of(cutter, blank, 0.02, poses), 0.02);
    EXPECT_LT(estimate.session_bytes(0.02), 2e6);
    // The faces alone have 28,000 mm2 in bricks of 0.14 mm.
    EXPECT_NEAR(estimate.vertices(0.02), 28000 / (0.14 * 0.14), 1e4);
}

TEST(MemoryEstimate, stays_small_itself_at_a_grid_finer_than_anything) {
    const std::vector<motion::ToolPose> poses{{{500, 500, -0.1}, {0, 0, 1}}, {{500.1, 500, -0.1}, {0, 0, 1}}};
    const Box3 blank{{0, 0, -100}, {1000, 1000, 0}};
    for (const double cell : {1e-4, 1e-6, 1e-9}) {
        const MemoryEstimate estimate(setup_of({}, blank, cell, poses), cell);
        EXPECT_GT(estimate.session_bytes(cell), 1e10) << cell;
    }
    EXPECT_GT(MemoryEstimate(setup_of({}, blank, 1e-9, {}), 1e-9).session_bytes(1e-9), 1e10);
}

TEST(MemoryEstimate, goes_by_the_area_where_the_bricks_are_many) {
    milling::Cutter cutter;
    cutter.kind = milling::CutterKind::ball;
    cutter.diameter_mm = 10;
    cutter.length_mm = 30;
    std::vector<motion::ToolPose> poses;
    for (int row = 0; row <= 50; ++row) {
        const double y = 2 * row;
        poses.push_back({{row % 2 == 0 ? 0.0 : 100.0, y, -2}, {0, 0, 1}});
        poses.push_back({{row % 2 == 0 ? 100.0 : 0.0, y, -2}, {0, 0, 1}});
    }
    const Box3 blank{{0, 0, -20}, {100, 100, 0}};
    // One surface of 100 x 100 mm: 1.26 to 2 bricks thick.
    for (const double cell : {1.0, 0.3, 0.1, 0.03}) {
        const double bricks = 1e4 / (49 * cell * cell);
        const double estimate = MemoryEstimate(setup_of(cutter, blank, cell, poses), cell).cut_bricks(cell);
        EXPECT_GT(estimate, bricks) << cell;
        EXPECT_LT(estimate, 2.5 * bricks) << cell;
    }
}

}  // namespace
}  // namespace tribo::session
