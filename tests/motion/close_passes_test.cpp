// SPDX-License-Identifier: MIT
#include "motion/path/close_passes.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace tribo::motion {
namespace {

using std::numbers::pi;

Move to(Vec3 from, Vec3 to, MoveKind kind = MoveKind::feed) {
    Move move;
    move.kind = kind;
    move.start.tip_mm = from;
    move.end.tip_mm = to;
    return move;
}

// To and fro along x, 40 mm long, `piece` mm a move.
std::vector<Move> raster(int passes, double sidestep, double piece, double z = 0) {
    std::vector<Move> moves;
    Vec3 at{0, 0, z};
    const auto go = [&](Vec3 next) {
        moves.push_back(to(at, next));
        at = next;
    };
    for (int n = 0; n < passes; ++n) {
        if (n > 0) go({at.x, n * sidestep, z});
        const bool forth = n % 2 == 0;
        const int pieces = static_cast<int>(std::lround(40 / piece));
        for (int k = 1; k <= pieces; ++k) go({forth ? 40.0 * k / pieces : 40 - 40.0 * k / pieces, at.y, z});
    }
    return moves;
}

TEST(ClosePasses, are_those_of_a_raster_and_as_far_apart_as_it_steps) {
    for (const double piece : {40.0, 5.0, 0.5}) {
        const ClosePasses found = close_passes(raster(30, 0.3, piece), 0.5);
        EXPECT_NEAR(found.sidestep_mm, 0.3, 1e-9) << piece;
        EXPECT_GT(found.share, 0.95) << piece;
        EXPECT_LE(found.share, 1) << piece;
        EXPECT_EQ(close_passes(raster(30, 0.51, piece), 0.5).share, 0) << piece;
    }
}

// A raster with a leaning axis; the plane of the passes turned about x does not change how it leans in it.
TEST(ClosePasses, say_how_the_tool_leans_from_the_plane_that_they_run_in) {
    const double tilt = 0.3, turn = 0.7, slope = 0.4;
    const auto turned = [&](Vec3 v) {
        return Vec3{v.x, v.y * std::cos(slope) - v.z * std::sin(slope),
                    v.y * std::sin(slope) + v.z * std::cos(slope)};
    };
    std::vector<Move> moves = raster(30, 0.3, 5);
    const Vec3 axis =
        turned({std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)});
    for (Move& m : moves) {
        m.start = {turned(m.start.tip_mm), axis};
        m.end = {turned(m.end.tip_mm), axis};
    }
    const ClosePasses found = close_passes(moves, 0.5);
    EXPECT_NEAR(found.sidestep_mm, 0.3, 1e-9);
    EXPECT_NEAR(found.tilt_rad, tilt, 1e-9);
    EXPECT_NEAR(found.turn_rad, turn, 1e-9);
    EXPECT_EQ(close_passes(raster(30, 0.3, 5), 0.5).tilt_rad, 0);
}

TEST(ClosePasses, count_by_the_share_of_the_path_that_has_them) {
    // 30 passes 1 mm apart and, far from them, 10 passes 0.2 mm apart.
    std::vector<Move> moves = raster(30, 1, 40);
    for (Move m : raster(10, 0.2, 40)) {
        m.start.tip_mm.y += 100;
        m.end.tip_mm.y += 100;
        moves.push_back(m);
    }
    const ClosePasses found = close_passes(moves, 0.5);
    EXPECT_NEAR(found.share, 0.25, 0.02);
    EXPECT_NEAR(found.sidestep_mm, 0.2, 1e-9);
}

TEST(ClosePasses, follow_curves_and_slopes) {
    // Rings 0.25 mm apart, run as arcs.
    std::vector<Move> rings;
    for (int n = 0; n < 40; ++n) {
        const double r = 10 + 0.25 * n;
        if (n > 0) rings.push_back(to({r - 0.25, 0, 0}, {r, 0, 0}));
        Move ring = to({r, 0, 0}, {r, 0, 0});
        ring.arc = Arc{{0, 0, 0}, {0, 0, 1}, 2 * pi};
        rings.push_back(ring);
    }
    const ClosePasses found = close_passes(rings, 0.4);
    EXPECT_NEAR(found.sidestep_mm, 0.25, 1e-3);
    EXPECT_GT(found.share, 0.95);
    // Level passes down a slope of 45 degrees: what counts is the distance on the slope.
    std::vector<Move> levels;
    for (int n = 0; n < 30; ++n) {
        const double d = 0.2 * n;
        levels.push_back(to({0, d, -d}, {40, d, -d}));
    }
    EXPECT_NEAR(close_passes(levels, 0.4).sidestep_mm, 0.2 * std::sqrt(2.0), 1e-9);
}

TEST(ClosePasses, are_not_the_same_track_again_nor_other_depths_nor_rapids_nor_crossings) {
    std::vector<Move> again = raster(10, 2, 40);
    for (const Move& m : raster(10, 2, 40)) again.push_back(m);
    EXPECT_EQ(close_passes(again, 0.5).share, 0);

    std::vector<Move> depths;
    for (int n = 0; n < 20; ++n) depths.push_back(to({0, 0, -0.1 * n}, {40, 0, -0.1 * n}));
    EXPECT_EQ(close_passes(depths, 0.5).share, 0);

    std::vector<Move> rapids = raster(20, 0.2, 40);
    for (std::size_t n = 1; n < rapids.size(); ++n) rapids[n].kind = MoveKind::rapid;
    EXPECT_EQ(close_passes(rapids, 0.5).share, 0);

    std::vector<Move> cross;
    for (int n = 0; n < 10; ++n) cross.push_back(to({2.0 * n, -20, 0}, {2.0 * n, 20, 0}));
    for (int n = 0; n < 10; ++n) cross.push_back(to({-20, 2.0 * n, 0}, {20, 2.0 * n, 0}));
    EXPECT_EQ(close_passes(cross, 0.5).share, 0);
}

TEST(ClosePasses, need_a_path) {
    EXPECT_EQ(close_passes({}, 1).share, 0);
    EXPECT_EQ(close_passes(std::vector{to({1, 2, 3}, {1, 2, 3})}, 1).share, 0);
    EXPECT_EQ(close_passes(std::vector{to({0, 0, 0}, {1e6, 0, 0})}, 0.01).share, 0);
}

}  // namespace
}  // namespace tribo::motion
