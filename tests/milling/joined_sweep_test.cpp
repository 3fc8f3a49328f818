// SPDX-License-Identifier: MIT
// The sweep of several moves is the union of the sweeps of each, whatever way they go.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <rapidcheck/gtest.h>
#include <string>
#include <vector>

#include "milling/any_profile.hpp"
#include "milling/sweep/profile_sweep.hpp"
#include "milling/sweep/sweep.hpp"
#include "milling/sweep/sweep_frames.hpp"
#include "milling/sweep/sweep_kernels.hpp"
#include "motion/path/program.hpp"
#include "motion/random_poses.hpp"

namespace tribo::milling {
namespace {

using motion::Move;

struct Chain {
    Cutter cutter;
    std::vector<Move> moves;
    std::unique_ptr<const field::Shape> joined;
    std::vector<std::unique_ptr<const field::Shape>> single;

    // The nearest of the single sweeps.
    const field::Shape& nearest(Vec3 p) const {
        return **std::ranges::min_element(single, {}, [&](const auto& s) { return s->distance_mm(p); });
    }
    double distance(Vec3 p) const { return nearest(p).distance_mm(p); }
    Vec3 any_point() const {
        const Box3 around = joined->bounds_mm().inflated(2);
        return {drawn(around.min.x, around.max.x), drawn(around.min.y, around.max.y),
                drawn(around.min.z, around.max.z)};
    }
};

// `kink` is the largest deviation of each move from the first, as a share of its length; `turn` the largest
// turn of the axis over each move.
Chain any_chain(double kink, double turn) {
    Chain chain;
    Cutter& c = chain.cutter;
    c.kind = static_cast<CutterKind>(*rc::gen::inRange(0, 3));
    c.diameter_mm = drawn(0.4, 12);
    c.corner_mm = c.kind == CutterKind::bull ? drawn(0.05, 0.95) * c.radius_mm() : 0;
    c.length_mm = drawn(0.7, 3) * c.diameter_mm;
    if (*rc::gen::inRange(0, 5) == 0) c = finished(form_tool());
    const Vec3 axis = motion::testing::direction();
    Vec3 way = motion::testing::direction();
    if (*rc::gen::inRange(0, 3) == 0) way = normalized(way - dot(way, axis) * axis, way);
    if (*rc::gen::inRange(0, 4) == 0) way = axis;
    motion::ToolPose pose{motion::testing::vector(5), axis};
    const int count = *rc::gen::inRange(2, 17);
    const double size = drawn(0.02, 3);
    for (int n = 0; n < count; ++n) {
        Move move;
        move.start = pose;
        Vec3 travel = drawn(0.3, 1) * size * (way + kink * motion::testing::vector(1));
        if (*rc::gen::inRange(0, 4) == 0) travel = travel - dot(travel, pose.axis) * pose.axis;
        pose.tip_mm += travel;
        if (turn > 0) pose.axis = normalized(pose.axis + turn * motion::testing::vector(0.5));
        move.end = pose;
        chain.moves.push_back(move);
    }
    std::vector<const Move*> moves;
    for (const Move& move : chain.moves) {
        moves.push_back(&move);
        chain.single.push_back(make_sweep(c, move));
    }
    chain.joined = make_sweep(c, moves);
    return chain;
}

// What a search of a turning axis or of a ramping bull nose proves.
constexpr double kSearched = 3e-5;

void is_the_union(const Chain& chain) {
    for (int n = 0; n < 30; ++n) {
        const Vec3 p = chain.any_point();
        const double truth = chain.distance(p), joined = chain.joined->distance_mm(p);
        const bool searched = chain.joined->is_searched() || chain.cutter.kind == CutterKind::bull;
        const double close = searched ? kSearched : 1e-9;
        if (!(std::abs(joined - truth) <= close))
            RC_FAIL(std::to_string(joined) + " where the nearest has " + std::to_string(truth));
        const double bound = drawn(-1, 1.5) * chain.cutter.radius_mm();
        const double below = chain.joined->distance_below(p, bound);
        // Each of the two is proven only so far; below a bound, those of a profile are too.
        const double alike = searched ? 2 * kSearched : chain.cutter.has_profile() ? 2 * kProvenMm : close;
        if (truth < bound - close) {
            RC_ASSERT(std::abs(below - truth) <= alike);
        } else {
            RC_ASSERT(below >= bound - alike);
        }
        const field::Shape::Slope slope = chain.joined->slope(p);
        RC_ASSERT(std::abs(slope.distance_mm - truth) <= close);
        const bool of_any = std::ranges::any_of(chain.single, [&](const auto& single) {
            return single->distance_mm(p) <= truth + close + 1e-7 &&
                   distance(single->gradient(p), slope.gradient) < 1e-4;
        });
        // At an edge of the tool the side that gives the gradient may be another one.
        if (!searched && chain.cutter.kind != CutterKind::flat) RC_ASSERT(of_any);
        RC_ASSERT(std::abs(length(slope.gradient) - 1) < 1e-9);
    }
}

RC_GTEST_PROP(JoinedSweep, is_the_union_of_moves_that_go_on, ()) {
    is_the_union(any_chain(drawn(0, 0.1), 0));
}
RC_GTEST_PROP(JoinedSweep, is_the_union_of_moves_that_go_anywhere, ()) {
    is_the_union(any_chain(drawn(0, 3), 0));
}
RC_GTEST_PROP(JoinedSweep, is_the_union_where_the_axis_turns, ()) {
    is_the_union(any_chain(drawn(0, 0.1), drawn(0.001, 0.05)));
}

RC_GTEST_PROP(JoinedSweep, is_sampled_as_the_union, ()) {
    const Chain chain = any_chain(drawn(0, 1), *rc::gen::inRange(0, 2) * 0.02);
    const double cell = drawn(0.02, 0.4) * chain.cutter.radius_mm(), near = 1.8 * cell;
    field::Lattice lattice;
    lattice.grid_origin_mm = chain.any_point();
    lattice.cell_mm = cell;
    std::array<float, field::kLatticeNodes> all, close, one, truth;
    chain.joined->sample(lattice, all.data());
    chain.joined->sample_near(lattice, near, close.data());
    truth.fill(1e30f);
    for (const auto& single : chain.single) {
        single->sample(lattice, one.data());
        for (std::size_t n = 0; n < one.size(); ++n) truth[n] = std::min(truth[n], one[n]);
    }
    for (std::size_t n = 0; n < one.size(); ++n) {
        const auto d = static_cast<double>(truth[n]);
        // Both are searched.
        constexpr double kAlike = 2 * kSearched;
        RC_ASSERT(std::abs(static_cast<double>(all[n]) - d) < kAlike);
        if (std::abs(d) < near - kAlike) {
            RC_ASSERT(std::abs(static_cast<double>(close[n]) - d) < kAlike);
        } else {
            const double side = d > 0 ? 1 : -1;
            RC_ASSERT(side * static_cast<double>(close[n]) > near - 2 * kAlike);
        }
    }
}

// The claim of is_whole_along.
RC_GTEST_PROP(JoinedSweep, is_whole_along_its_axis, ()) {
    const Chain chain = any_chain(0.05, 0);
    const Vec3 axis = chain.moves.front().start.axis;
    if (!chain.joined->is_whole_along(axis)) return;
    for (int line = 0; line < 10; ++line) {
        const Vec3 middle = chain.any_point();
        int pieces = 0;
        bool inside = false;
        for (double h = -40; h < 40; h += 0.01) {
            const bool now = chain.joined->distance_below(middle + h * axis, 1e-7) < 1e-7;
            if (now && !inside) ++pieces;
            inside = now;
        }
        RC_ASSERT(pieces <= 1);
    }
}

// A chain of one is the sweep of the move, and both builds of the kernel give the same bits.
TEST(JoinedSweep, of_one_move_is_the_sweep_of_the_move) {
    Cutter cutter;
    cutter.kind = CutterKind::ball;
    cutter.diameter_mm = 6;
    cutter.length_mm = 12;
    Move move;
    move.start = {{0, 0, 0}, {0, 0, 1}};
    move.end = {{1, 0.2, -0.1}, {0, 0, 1}};
    const Move* const one = &move;
    const auto joined = make_sweep(cutter, std::span(&one, 1)), single = make_sweep(cutter, move);
    for (const Vec3 p : {Vec3{0.3, 3.4, 2}, Vec3{2, 1, -1}, Vec3{0.5, 0, 20}})
        EXPECT_EQ(joined->distance_mm(p), single->distance_mm(p));
}

TEST(JoinedSweep, has_the_same_bits_on_every_processor) {
    if (!sweep_kernels_v3()) GTEST_SKIP() << "no x86-64-v3 here";
    const Frame frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::array<StraightPart, 3> parts{StraightPart{{0, 0, 0}, 1, 0, {0.4, 0.1}},
                                            {{0.4, 0, 0.1}, 0.8, 0.6, {0.5, -0.2}},
                                            {{0.8, 0.3, -0.1}, 0.6, 0.8, {0.3, 0}}};
    Cutter cutter;
    cutter.diameter_mm = 3;
    cutter.length_mm = 8;
    for (const CutterKind kind : {CutterKind::flat, CutterKind::ball, CutterKind::bull}) {
        cutter.kind = kind;
        cutter.corner_mm = kind == CutterKind::bull ? 0.7 : 0;
        for (int n = 0; n < 64; ++n) {
            const field::Lattice lattice{{-2, -2, -2}, 0.2, 6 * (n % 4), 6 * (n / 4 % 4), 6 * (n / 16)};
            std::array<float, field::kLatticeNodes> a, b;
            sweep_kernels_sse2()->joined_straight(ToolProfile(cutter), parts, frame, {}, lattice, 0.36,
                                                  a.data());
            sweep_kernels_v3()->joined_straight(ToolProfile(cutter), parts, frame, {}, lattice, 0.36,
                                                b.data());
            ASSERT_EQ(a, b);
        }
    }
}

// A curved sweep that is asked only for what is nearer than another one, and its bound from the middle: the
// same bits from both builds, and bounds that hold.
RC_GTEST_PROP(JoinedSweep, of_turning_axes_has_the_same_bits_on_every_processor, ()) {
    if (!sweep_kernels_v3()) RC_DISCARD("no x86-64-v3 here");
    const Chain chain = any_chain(drawn(0, 0.1), drawn(0.001, 0.05));
    if (chain.cutter.has_profile()) return;
    const ToolProfile tool(chain.cutter);
    const double cell = drawn(0.02, 0.4) * chain.cutter.radius_mm(), near = 1.8 * cell;
    const field::Lattice lattice{chain.any_point(), cell};
    std::array<float, field::kLatticeNodes> known, a, b;
    chain.single.front()->sample_near(lattice, near, known.data());
    for (const Move& move : chain.moves) {
        const CurvedLine line = curved_line(move);
        const CurvedInstants instants(line);
        sweep_kernels_sse2()->curved(tool, line, instants, move.start.tip_mm, lattice, near, known.data(),
                                     a.data());
        sweep_kernels_v3()->curved(tool, line, instants, move.start.tip_mm, lattice, near, known.data(),
                                   b.data());
        RC_ASSERT(a == b);
    }
    TravelMiddles travels{};
    for (std::size_t n = 0; n < TravelMiddles::kCount; ++n) {
        const Move& move = chain.moves[n % chain.moves.size()];
        travels.put(static_cast<int>(n), curved_line(move), move.start.tip_mm - chain.moves[0].start.tip_mm);
    }
    for (int n = 0; n < 20; ++n) {
        const Vec3 p = chain.any_point(), from_start = p - chain.moves[0].start.tip_mm;
        std::array<float, TravelMiddles::kCount> low, same;
        sweep_kernels_sse2()->lower_bounds(tool, travels, from_start, low.data());
        sweep_kernels_v3()->lower_bounds(tool, travels, from_start, same.data());
        RC_ASSERT(low == same);
        for (std::size_t k = 0; k < low.size(); ++k)
            RC_ASSERT(static_cast<double>(low[k]) <= chain.single[k % chain.single.size()]->distance_mm(p));
    }
}

}  // namespace
}  // namespace tribo::milling
