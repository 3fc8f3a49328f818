// SPDX-License-Identifier: MIT
// A job on the stock that another one left, against one job that does both, and against the volume counted by
// chance (Monte Carlo).
#include "session/cut/earlier_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "job/solid.hpp"
#include "milling/sweep/sweep.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/moves.hpp"
#include "session/cut/mill_session.hpp"
#include "session/kept_rows.hpp"

namespace tribo::session {
namespace {

using milling::Cutter;
using milling::CutterKind;
using motion::WorkFrame;

// Draws in the order of the calls.
class Draw {
  public:
    explicit Draw(std::uint64_t seed) : noise_(seed) {}
    double in(double low, double high) { return low + (high - low) * noise_.uniform(count_++); }
    int below(int count) {
        return static_cast<int>(noise_.bits(count_++) % static_cast<std::uint64_t>(count));
    }
    Vec3 point(const Box3& box) {
        const double x = in(box.min.x, box.max.x), y = in(box.min.y, box.max.y);
        return {x, y, in(box.min.z, box.max.z)};
    }
    // Evenly over all directions.
    Vec3 direction() {
        for (;;) {
            const Vec3 v = point({{-1, -1, -1}, {1, 1, 1}});
            if (length(v) > 0.1 && length(v) < 1) return normalized(v);
        }
    }

  private:
    CounterNoise noise_;
    std::uint64_t count_ = 0;
};

Cutter random_cutter(Draw& draw) {
    Cutter cutter;
    cutter.kind = static_cast<CutterKind>(draw.below(3));
    cutter.diameter_mm = draw.in(3, 10);
    if (cutter.kind == CutterKind::bull) cutter.corner_mm = cutter.diameter_mm * draw.in(0.1, 0.4);
    cutter.flutes = 1 + draw.below(4);
    cutter.length_mm = 40;
    return cutter;
}

// Feed moves of all kinds about a box: straight, arcs, turning axes, rapids, with the axis about `up`.
std::vector<motion::Move> random_moves(Draw& draw, const Box3& box, Vec3 up, int count, int first_line = 1) {
    std::vector<motion::Move> moves;
    const auto axis_near = [&](double off) { return normalized(up + off * draw.direction()); };
    Vec3 at = draw.point(box), axis = axis_near(0.3);
    for (int n = 0; n < count; ++n) {
        motion::Move move;
        move.start = {at, axis};
        move.feed_mm_per_min = draw.in(200, 1000);
        move.line = first_line + n;
        at = draw.point(box);
        switch (draw.below(5)) {
            case 0:
                move.kind = motion::MoveKind::rapid;
                break;
            case 1: {  // a circle's part about the axis
                const Vec3 across = normalized(cross(axis, draw.direction()));
                move.arc = motion::Arc{move.start.tip_mm + draw.in(2, 8) * across, axis, draw.in(-5, 5)};
                move.end = {{}, axis};
                move.end = motion::pose_at(move, 1);
                const Vec3 arm = move.start.tip_mm - move.arc->centre_mm;
                const double c = std::cos(move.arc->turn_rad), s = std::sin(move.arc->turn_rad);
                at = move.arc->centre_mm + c * arm + s * cross(axis, arm);
                break;
            }
            case 2:
                axis = axis_near(0.3);
                break;
            default:
                break;
        }
        move.end = {at, axis};
        moves.push_back(move);
    }
    return moves;
}

void add(MillSetup& setup, const Cutter& cutter, const std::vector<motion::Move>& moves) {
    setup.cutters.push_back(cutter);
    for (const motion::Move& move : moves) {
        for (const motion::Move& piece : motion::to_elementary(move)) {
            setup.moves.push_back(piece);
            setup.cutter_of_move.push_back(setup.cutters.size() - 1);
            setup.rpm_of_move.push_back(6000);
        }
    }
}

MillSetup setup_on(const Box3& blank, const motion::WorkFrame& frame, double cell_mm) {
    MillSetup setup;
    setup.coefficients = milling::find_material("al7075-t6")->coefficients;
    setup.blank = job::shape_of(job::box_solid(blank), frame);
    setup.blank_volume_mm3 = blank.volume();
    setup.cell_mm = cell_mm;
    return setup;
}

// The cuts of a setup as the next one's earlier ones.
EarlierCuts turned(EarlierCuts cuts, const motion::WorkFrame& frame) {
    for (motion::Move& move : cuts.moves) move = in_frame(move, frame);
    return cuts;
}

struct Rows {
    std::vector<KeptRow> rows;
    MillTotals totals;
    std::unique_ptr<MillSession> session;
};

// Stops for a moment at `stop_s`, so that what comes later is measured on the stock as it is by then.
Rows milled(MillSetup setup, double stop_s = 0) {
    Rows result;
    result.session = std::make_unique<MillSession>(std::move(setup), serial_for);
    const MillSinks sinks = keep_rows(result.rows);
    result.session->run_to(stop_s, sinks);
    result.session->run(sinks);
    result.totals = result.session->totals();
    return result;
}

// The frame as a matrix of rows: a second way to the same coordinates.
struct Matrix {
    double m[3][3];
    Vec3 origin;
    Vec3 of_direction(Vec3 v) const {
        Vec3 out;
        for (int i = 0; i < 3; ++i) out[i] = m[i][0] * v.x + m[i][1] * v.y + m[i][2] * v.z;
        return out;
    }
    Vec3 of_point(Vec3 p) const { return of_direction(p - origin); }
};

// All 24 turns by right angles.
std::vector<motion::WorkFrame> right_angles() {
    std::vector<motion::WorkFrame> frames;
    const Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const Vec3 x : axes) {
        for (const Vec3 z : axes) {
            if (dot(x, z) == 0) frames.push_back({{}, x, cross(z, x), z});
        }
    }
    return frames;
}

// About 19 by 15 by 12 mm: whole bricks of seven cells, less what the grid stands off the blank on both sides
// together, so that nodes and bricks are the same from whichever side they are counted.
constexpr double kCell = 0.5, kMarginCells = 2.37;
// How exact the sweep of a turning axis is at its surface (milling/sweep.hpp).
constexpr double kSweepMm = 1e-4;
Box3 mirrored_box() {
    const auto edge = [](double cells) { return kCell * (cells - 2 * kMarginCells); };
    return {{0, 0, 0}, {edge(42), edge(35), edge(28)}};
}

// One job of two programs in one go, and the second of them on the stock that the first leaves.
struct Twice {
    Rows first, one, chain;

    Twice(Draw& draw, bool stop) {
        const Box3 about = kBlank.inflated(3);
        const Cutter cutter_a = random_cutter(draw), cutter_b = random_cutter(draw);
        const auto a = random_moves(draw, about, {0, 0, 1}, 8);
        const auto b = random_moves(draw, about, {0, 0, 1}, 8, 100);
        const double cell = draw.in(0.3, 0.7);
        MillSetup alone = setup_on(kBlank, {}, cell);
        add(alone, cutter_a, a);
        first = milled(std::move(alone));
        MillSetup both = setup_on(kBlank, {}, cell);
        add(both, cutter_a, a);
        add(both, cutter_b, b);
        one = milled(std::move(both), stop ? first.totals.duration_s : 0);
        MillSetup next = setup_on(kBlank, {}, cell);
        next.earlier.push_back(planned_cuts(first.session->setup()));
        add(next, cutter_b, b);
        chain = milled(std::move(next));
    }
    static constexpr Box3 kBlank{{-15, -12, -10}, {15, 12, 0}};
};

TEST(EarlierCuts, and_the_rest_are_one_job_that_pauses_in_between_to_the_last_bit) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Draw draw(seed);
        const Twice t(draw, true);
        EXPECT_NEAR(t.first.totals.removed_mm3 + t.chain.totals.removed_mm3, t.one.totals.removed_mm3, 1e-9);
        EXPECT_NEAR(t.chain.totals.remaining_mm3, t.one.totals.remaining_mm3, 1e-9);
        EXPECT_EQ(t.chain.totals.collisions.size() + t.first.totals.collisions.size(),
                  t.one.totals.collisions.size());
        ASSERT_EQ(t.first.rows.size() + t.chain.rows.size(), t.one.rows.size()) << seed;
        ASSERT_GT(t.chain.rows.size(), 20u);
        for (std::size_t n = 0; n < t.chain.rows.size(); ++n) {
            const auto& [row, force] = t.chain.rows[n];
            const auto& [same, same_force] = t.one.rows[t.first.rows.size() + n];
            EXPECT_EQ(row.line, same.line);
            EXPECT_EQ(row.pose.tip_mm, same.pose.tip_mm);
            const milling::EngagementHull hull = milling::hull(row.engagement);
            const milling::EngagementHull same_hull = milling::hull(same.engagement);
            EXPECT_EQ(hull.entry_rad, same_hull.entry_rad) << "seed " << seed << " row " << n;
            EXPECT_EQ(hull.exit_rad, same_hull.exit_rad);
            EXPECT_EQ(hull.axial_depth_mm, same_hull.axial_depth_mm);
            EXPECT_EQ(row.removed_mm3, same.removed_mm3);
            // The feed is a length over a difference of times, which are later in the one job.
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(force.peaks.mean_n[k], same_force.peaks.mean_n[k],
                            1e-9 * (1 + length(same_force.peaks.mean_n)))
                    << n;
        }
        for (int n = 0; n < 2000; ++n) {
            const Vec3 p = draw.point(Twice::kBlank);
            ASSERT_EQ(t.chain.session->stock().distance_mm(p), t.one.session->stock().distance_mm(p));
        }
    }
}

TEST(EarlierCuts, and_the_rest_are_one_job_as_well_as_a_curved_sweep_is_found) {
    for (std::uint64_t seed = 20; seed < 28; ++seed) {
        Draw draw(seed);
        const Twice t(draw, false);
        EXPECT_NEAR(t.first.totals.removed_mm3 + t.chain.totals.removed_mm3, t.one.totals.removed_mm3, 1e-6);
        EXPECT_NEAR(t.chain.totals.remaining_mm3, t.one.totals.remaining_mm3, 1e-6);
        ASSERT_EQ(t.first.rows.size() + t.chain.rows.size(), t.one.rows.size()) << seed;
        for (std::size_t n = 0; n < t.chain.rows.size(); ++n) {
            const auto& [row, force] = t.chain.rows[n];
            const auto& [same, same_force] = t.one.rows[t.first.rows.size() + n];
            // Which of the sweeps just made are still looked at one by one depends on how the moves are taken
            // together; the search for the nearest instant of a curved one then starts elsewhere.
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(force.peaks.mean_n[k], same_force.peaks.mean_n[k],
                            1e-4 * (1 + length(same_force.peaks.mean_n)))
                    << seed << " " << n;
        }
    }
}

TEST(EarlierCuts, turned_by_right_angles_take_the_same_volume_where_the_grids_meet) {
    const Box3 blank = mirrored_box();
    const Box3 about = blank.inflated(3);
    std::uint64_t seed = 100;
    int compared = 0;
    for (motion::WorkFrame frame : right_angles()) {
        Draw draw(seed++);
        const Vec3 up = draw.direction();
        const Cutter first = random_cutter(draw), second = random_cutter(draw);
        const auto a = random_moves(draw, about, up, 4), b = random_moves(draw, about, frame.z, 4, 100);
        frame.origin_mm = draw.point({{-50, -50, -50}, {50, 50, 50}});

        MillSetup alone = setup_on(blank, {}, kCell);
        add(alone, first, a);
        const Rows before = milled(std::move(alone));
        MillSetup both = setup_on(blank, {}, kCell);
        add(both, first, a);
        add(both, second, b);
        const Rows one = milled(std::move(both));

        MillSetup next = setup_on(blank, frame, kCell);
        next.earlier.push_back(turned(planned_cuts(before.session->setup()), frame));
        std::vector<motion::Move> own;
        for (const motion::Move& move : b) own.push_back(in_frame(move, frame));
        add(next, second, own);
        const Rows chain = milled(std::move(next));

        // Nodes are held in single precision: each cell's share of a surface is good to some 1e-6 of a cell.
        EXPECT_NEAR(chain.totals.remaining_mm3, one.totals.remaining_mm3, 1e-3) << seed;
        EXPECT_NEAR(before.totals.removed_mm3 + chain.totals.removed_mm3, one.totals.removed_mm3, 1e-3);
        for (int n = 0; n < 20000; ++n) {
            const Vec3 p = draw.point(blank);
            const double distance = one.session->stock().distance_mm(p);
            if (std::abs(distance) > 0.2 * kCell) continue;  // only the surface is exact
            ++compared;
            EXPECT_NEAR(chain.session->stock().distance_mm(frame.from_stock(p)), distance, kSweepMm) << seed;
        }
    }
    EXPECT_GT(compared, 1000);
}

// The share of a box that no sweep takes, counted at random points in the first job's coordinates.
double left_by_chance(const Box3& blank, const MillSetup& setup, Draw& draw, int points) {
    std::vector<std::unique_ptr<field::Shape>> sweeps;
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        sweeps.push_back(milling::make_sweep(setup.cutters[setup.cutter_of_move[n]], setup.moves[n]));
    }
    int left = 0;
    for (int n = 0; n < points; ++n) {
        const Vec3 p = draw.point(blank);
        left += std::none_of(sweeps.begin(), sweeps.end(),
                             [&](const auto& sweep) { return sweep->distance_mm(p) < 0; });
    }
    return static_cast<double>(left) / points;
}

TEST(EarlierCuts, turned_anyhow_leave_the_volume_that_chance_finds) {
    const Box3 blank{{-12, -10, -8}, {12, 10, 0}};
    constexpr int kPoints = 40'000;
    for (std::uint64_t seed = 200; seed < 208; ++seed) {
        Draw draw(seed);
        motion::WorkFrame frame;
        frame.origin_mm = draw.point({{-100, -100, -100}, {100, 100, 100}});
        frame.z = draw.direction();
        frame.x = normalized(cross(frame.z, draw.direction()));
        frame.y = cross(frame.z, frame.x);
        const Cutter first = random_cutter(draw), second = random_cutter(draw);
        const auto a = random_moves(draw, blank.inflated(3), draw.direction(), 3);
        const auto b = random_moves(draw, blank.inflated(3), frame.z, 3);

        // The second program is turned by a matrix, not by in_frame().
        const motion::WorkFrame& f = frame;
        const Matrix turn{{{f.x.x, f.x.y, f.x.z}, {f.y.x, f.y.y, f.y.z}, {f.z.x, f.z.y, f.z.z}}, f.origin_mm};
        std::vector<motion::Move> own = b;
        for (motion::Move& move : own) {
            for (motion::ToolPose* pose : {&move.start, &move.end})
                *pose = {turn.of_point(pose->tip_mm), turn.of_direction(pose->axis)};
            if (move.arc) {
                move.arc->centre_mm = turn.of_point(move.arc->centre_mm);
                move.arc->normal = turn.of_direction(move.arc->normal);
            }
        }
        MillSetup both = setup_on(blank, {}, 0.3);
        add(both, first, a);
        const EarlierCuts earlier = planned_cuts(both);
        add(both, second, b);
        const double share = left_by_chance(blank, both, draw, kPoints);
        const double one = milled(std::move(both)).totals.remaining_mm3;
        MillSetup next = setup_on(blank, frame, 0.3);
        next.earlier.push_back(turned(earlier, frame));
        add(next, second, own);
        const double chain = milled(std::move(next)).totals.remaining_mm3;

        const double deviation = blank.volume() * std::sqrt(share * (1 - share) / kPoints);
        EXPECT_NEAR(chain, share * blank.volume(), 4 * deviation + 2e-3 * blank.volume()) << seed;
        EXPECT_NEAR(chain, one, 1e-3 * blank.volume()) << seed;
    }
}

}  // namespace
}  // namespace tribo::session
