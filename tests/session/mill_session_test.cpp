// SPDX-License-Identifier: MIT
// A rendered cut against what geometry and the closed forms of cutting force say: forces, volumes, chips,
// heights.
#include "session/cut/mill_session.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <thread>

#include "field/shape/box_shape.hpp"
#include "milling/sweep/sweep.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/moves.hpp"

namespace tribo::session {
namespace {

using milling::Cutter;
using milling::CutterKind;
using std::numbers::pi;

motion::Move feed(Vec3 from, Vec3 to, Vec3 axis = {0, 0, 1}) {
    motion::Move m;
    m.start = {from, axis};
    m.end = {to, axis};
    m.feed_mm_per_min = 600;
    m.line = 1;
    return m;
}

MillSetup setup_of(Cutter cutter, Box3 blank, double cell, const std::vector<motion::Move>& moves,
                   double rpm = 6000) {
    MillSetup s;
    s.cutters = {std::move(cutter)};
    s.coefficients = milling::find_material("al7075-t6")->coefficients;
    s.blank = std::make_unique<field::BoxShape>(blank);
    s.blank_volume_mm3 = blank.volume();
    s.cell_mm = cell;
    for (const motion::Move& move : moves) {
        for (const motion::Move& piece : motion::to_elementary(move)) {
            s.moves.push_back(piece);
            s.cutter_of_move.push_back(0);
            s.rpm_of_move.push_back(rpm);
        }
    }
    return s;
}

Cutter cutter(CutterKind kind, double diameter, int flutes = 2) {
    Cutter c;
    c.kind = kind;
    c.diameter_mm = diameter;
    if (kind == CutterKind::bull) c.corner_mm = diameter / 6;
    c.flutes = flutes;
    c.helix_deg = 30;
    c.length_mm = 40;
    return c;
}

// One of the analytic cases: a straight cut along +x through a block of which a first pass has left the
// material between `from_y` and `to_y` of the tool's axis.
struct Case {
    const char* name;
    const char* material;
    double diameter;
    int flutes;
    double depth, feed_per_tooth, from_y, to_y;
    Vec3 peak;
    double peak_xy, peak_torque_nm;
    Vec3 mean;
};

// Extremes and means of the closed form, 1,440 angles, cross-checked with 4,000 slices (docs/printed-model.md
// has the conventions). Up milling leaves material on the left of the feed, down milling on its right.
const Case kCases[] = {
    {"slot",
     "al7075-t6",
     12,
     2,
     2,
     0.10,
     -20,
     20,
     {-171.1, 218.4, -45.7},
     225.6,
     1.251,
     {-50.75, 111.97, -29.67}},
    {"half up",
     "al7075-t6",
     12,
     4,
     5,
     0.05,
     0,
     20,
     {-304.7, 270.1, -56.9},
     362.9,
     1.938,
     {-254.98, 85.95, -38.83}},
    {"half down",
     "al7075-t6",
     12,
     4,
     5,
     0.05,
     -20,
     0,
     {141.4, 353.6, -56.8},
     363.2,
     1.937,
     {43.44, 282.15, -38.83}},
    {"quarter down",
     "al7075-hss",
     19.05,
     4,
     10,
     0.08,
     -20,
     -19.05 / 4,
     {293.6, 605.3, -183.5},
     660.6,
     5.892,
     {165.89, 296.70, -89.70}},
};

TEST(MillSession, forces_of_a_rendered_cut_are_those_of_the_closed_form) {
    for (const Case& c : kCases) {
        constexpr double kRpm = 6000;
        std::vector<motion::Move> moves;
        motion::Move cut = feed({-15, 20, -c.depth}, {45, 20, -c.depth});
        cut.feed_mm_per_min = c.feed_per_tooth * c.flutes * kRpm;
        MillSetup s = setup_of(cutter(CutterKind::flat, c.diameter, c.flutes),
                               {{0, std::max(0.0, 20 + c.from_y), -12}, {40, std::min(40.0, 20 + c.to_y), 0}},
                               0.1, {cut}, kRpm);
        s.coefficients = milling::find_material(c.material)->coefficients;
        MillSession session(std::move(s), serial_for);
        int rows = 0;
        ASSERT_TRUE(session.run(
            {[&](const milling::CutRow& row, const milling::RowForce& force) {
                 if (row.pose.tip_mm.x < 12 || row.pose.tip_mm.x > 28) return;
                 ++rows;
                 for (int k = 0; k < 3; ++k) {
                     EXPECT_NEAR(force.peaks.peak_n[k] / c.peak[k], 1, 0.02) << c.name << k;
                     EXPECT_NEAR(force.peaks.mean_n[k] / c.mean[k], 1, 0.02) << c.name << k;
                 }
                 EXPECT_NEAR(force.peaks.peak_xy_n / c.peak_xy, 1, 0.02) << c.name;
                 EXPECT_NEAR(1e-3 * force.peaks.peak_torque_nmm / c.peak_torque_nm, 1, 0.02) << c.name;
             },
             {}}));
        EXPECT_GT(rows, 20) << c.name;
    }
}

double removed_by(MillSetup setup) {
    MillSession session(std::move(setup), serial_for);
    EXPECT_TRUE(session.run({}));
    EXPECT_NEAR(session.totals().chip_mm3 / session.totals().fed_mm3, 1, 0.005);
    return session.totals().removed_mm3;
}

constexpr double kVolumeTolerance = 0.003;

TEST(MillSession, removes_the_volume_of_a_flat_groove) {
    const double removed = removed_by(setup_of(cutter(CutterKind::flat, 8), {{0, 0, -10}, {40, 30, 0}}, 0.1,
                                               {feed({-10, 15, -3}, {50, 15, -3})}));
    EXPECT_NEAR(removed / (40 * 8 * 3), 1, kVolumeTolerance);
}

TEST(MillSession, removes_the_volume_of_a_ball_groove) {
    const double removed = removed_by(setup_of(cutter(CutterKind::ball, 8), {{0, 0, -10}, {40, 30, 0}}, 0.1,
                                               {feed({-10, 15, -1.5}, {50, 15, -1.5})}));
    const double half = std::acos(1 - 1.5 / 4);
    EXPECT_NEAR(removed / (40 * 16 * (half - std::sin(half) * std::cos(half))), 1, kVolumeTolerance);
}

TEST(MillSession, removes_the_volume_of_a_tilted_groove) {
    // Leaning 20 degrees forward, the bottom circle is seen along the feed as half an ellipse, 6 by 6 sin 20.
    const double lean = 20 * pi / 180, depth = 1.2;
    const Vec3 axis{std::sin(lean), 0, std::cos(lean)};
    const double below = 6 * std::sin(lean);  // of the front edge under the tip
    const double removed =
        removed_by(setup_of(cutter(CutterKind::flat, 12), {{0, 0, -10}, {60, 30, 0}}, 0.1,
                            {feed({-20, 15, below - depth}, {80, 15, below - depth}, axis)}));
    // Segment of the ellipse up to `depth` above its lowest point.
    const double c = 1 - depth / below, angle = std::acos(c);
    EXPECT_NEAR(removed / (60 * 6 * below * (angle - c * std::sin(angle))), 1, kVolumeTolerance);
}

TEST(MillSession, removes_the_volume_of_a_helical_plunge) {
    // Two turns of radius 3 with a cutter of 8, 4 mm deep, and a level turn: a round hole of 14 mm.
    motion::Move helix = feed({23, 15, 0}, {23, 15, -4});
    helix.arc = motion::Arc{{20, 15, 0}, {0, 0, 1}, 4 * pi};
    motion::Move level = feed({23, 15, -4}, {23, 15, -4});
    level.arc = motion::Arc{{20, 15, -4}, {0, 0, 1}, 2 * pi};
    const double removed =
        removed_by(setup_of(cutter(CutterKind::flat, 8), {{0, 0, -10}, {40, 30, 0}}, 0.1, {helix, level}));
    EXPECT_NEAR(removed / (pi * 49 * 4), 1, kVolumeTolerance);
}

double height_at(const field::CarvedField& f, double x, double y) {
    double lo = -5, hi = 0.5;
    for (int n = 0; n < 60; ++n) {
        const double mid = 0.5 * (lo + hi);
        (f.distance_mm({x, y, mid}) > 0 ? hi : lo) = mid;
    }
    return 0.5 * (lo + hi);
}

TEST(MillSession, leaves_the_scallops_of_an_inclined_flat_end_mill) {
    // Passes 4 mm apart, leaning 5 to 20 degrees: h = R sin(lean) (1 - sqrt(1 - (s / 2R)^2)).
    for (const double degrees : {5.0, 10.0, 20.0}) {
        for (const double cell : {0.5, 1.0, 2.0}) {
            const double lean = degrees * pi / 180, below = 6 * std::sin(lean);
            const Vec3 axis{std::sin(lean), 0, std::cos(lean)};
            std::vector<motion::Move> passes;
            for (double y = 4; y <= 36; y += 4) {
                passes.push_back(feed({-20, y, below - 1.5}, {70, y, below - 1.5}, axis));
            }
            MillSession session(
                setup_of(cutter(CutterKind::flat, 12), {{0, 0, -10}, {50, 40, 0}}, cell, passes), serial_for);
            ASSERT_TRUE(session.run({}));
            const double expected = below * (1 - std::sqrt(1 - 1.0 / 9));
            const double cusp = height_at(session.stock(), 25.3, 18),
                         valley = height_at(session.stock(), 25.3, 20);
            EXPECT_NEAR(valley, -1.5, 1e-4) << degrees << " " << cell;
            EXPECT_NEAR(cusp - valley, expected, std::max(0.001, 0.01 * expected)) << degrees << " " << cell;
        }
    }
}

TEST(MillSession, shows_no_waves_at_any_sidestep) {
    // A wave would show as cusps of different height: grid and passes beat when the sidestep is near a
    // multiple of the cell.
    const double cell = 0.2;
    for (const double cells : {2.0, 2.3, 3.1, 4.9, 7.0, 10.1, 20.0}) {
        const double sidestep = cells * cell, radius = 3;
        std::vector<motion::Move> passes;
        for (int n = 0; n * sidestep <= 16; ++n)
            passes.push_back(feed({-5, 2 + n * sidestep, -1}, {15, 2 + n * sidestep, -1}));
        MillSession session(
            setup_of(cutter(CutterKind::ball, 2 * radius), {{0, 0, -4}, {10, 20, 0}}, cell, passes),
            serial_for);
        ASSERT_TRUE(session.run({}));
        const double expected = radius - std::sqrt(radius * radius - 0.25 * sidestep * sidestep) - 1;
        for (int n = 2; (n + 3) * sidestep <= 16; ++n) {
            EXPECT_NEAR(height_at(session.stock(), 5.03, 2 + (n + 0.5) * sidestep), expected, 1e-4) << cells;
        }
    }
}

TEST(MillSession, reports_a_rapid_through_stock_with_its_place) {
    motion::Move rapid = feed({-10, 15, -2}, {50, 15, -2});
    rapid.kind = motion::MoveKind::rapid;
    rapid.line = 7;
    MillSession session(setup_of(cutter(CutterKind::flat, 8), {{0, 0, -10}, {40, 30, 0}}, 0.25, {rapid}),
                        serial_for);
    ASSERT_TRUE(session.run({}));
    const auto& found = session.totals().collisions;
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, milling::CollisionKind::rapid_through_stock);
    EXPECT_EQ(found[0].line, 7);
    EXPECT_NEAR(found[0].tip_mm.x, -4, 2.1);
    EXPECT_NEAR(found[0].t_s, 6 / (10000 / 60.0), 0.02);
}

TEST(MillSession, reports_shank_holder_and_fixture) {
    Cutter c = cutter(CutterKind::flat, 6);
    c.length_mm = 5;
    c.holder = {{6, 3}, {30, 20}};
    MillSetup s = setup_of(c, {{0, 0, -20}, {40, 30, 0}}, 0.25, {feed({-20, 15, -9}, {20, 15, -9})});
    s.fixtures.push_back(std::make_unique<field::BoxShape>(Box3{{15, 0, -20}, {25, 30, -8}}));
    MillSession session(std::move(s), serial_for);
    ASSERT_TRUE(session.run({}));
    std::vector<milling::CollisionKind> kinds;
    for (const MillCollision& found : session.totals().collisions) kinds.push_back(found.kind);
    const auto has = [&](milling::CollisionKind kind) {
        return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
    };
    EXPECT_TRUE(has(milling::CollisionKind::shank));
    EXPECT_TRUE(has(milling::CollisionKind::holder));
    EXPECT_TRUE(has(milling::CollisionKind::tool_in_fixture));
    EXPECT_FALSE(has(milling::CollisionKind::rapid_through_stock));
}

// Towards a fixture, however thin and however little of it is touched: where the cutter's edge, the shank or
// the holder first comes to it.
TEST(MillSession, reports_a_collision_where_it_begins) {
    Cutter c = cutter(CutterKind::flat, 6);
    c.length_mm = 5;
    c.holder = {{8, 3}, {30, 20}};
    for (const double thick : {0.01, 1.0, 20.0}) {
        for (const double aside : {0.0, 2.5, 2.995}) {
            MillSetup s = setup_of(c, {{0, 0, -20}, {60, 30, 0}}, 0.5, {feed({-30, 15, -3}, {90, 15, -3})});
            const double edge_y = 15 + aside;
            for (const Box3& box :
                 {Box3{{40, edge_y, -20}, {40 + thick, 30, 1}}, Box3{{61, edge_y, 2.5}, {61 + thick, 30, 4}}})
                s.fixtures.push_back(std::make_unique<field::BoxShape>(box));
            MillSession session(std::move(s), serial_for);
            ASSERT_TRUE(session.run({}));
            const auto& found = session.totals().collisions;
            ASSERT_GE(found.size(), 2u) << thick << ' ' << aside;
            const auto first = [&](double radius) { return std::sqrt(radius * radius - aside * aside); };
            for (const MillCollision& one : found) {
                const bool is_tool = one.kind == milling::CollisionKind::tool_in_fixture;
                EXPECT_NEAR(one.tip_mm.x, is_tool ? 40 - first(3) : 61 - first(4), 0.2)
                    << thick << ' ' << aside;
            }
        }
    }
}

// A wall 3 mm high that the shank, 8 mm wide from 5 mm above the tip on, runs into.
TEST(MillSession, reports_a_shank_where_it_comes_to_the_stock) {
    Cutter c = cutter(CutterKind::flat, 6);
    c.length_mm = 5;
    c.holder = {{8, 30}};
    MillSession session(setup_of(c, {{0, 0, -20}, {60, 30, 0}}, 0.25, {feed({-30, 15, -8}, {90, 15, -8})}),
                        serial_for);
    ASSERT_TRUE(session.run({}));
    const auto& found = session.totals().collisions;
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].tip_mm.x, -4, 0.5);
}

TEST(MillSession, stops_at_the_time_asked_for) {
    MillSetup s = setup_of(cutter(CutterKind::flat, 8), {{0, 0, -10}, {40, 30, 0}}, 0.25,
                           {feed({-10, 15, -3}, {50, 15, -3})});
    s.until_s = 3;  // 30 mm: the tool's axis at x = 20
    MillSession session(std::move(s), serial_for);
    ASSERT_TRUE(session.run({}));
    EXPECT_DOUBLE_EQ(session.totals().duration_s, 3);
    EXPECT_NEAR(session.totals().path_mm, 30, 1e-9);
    EXPECT_TRUE(session.stock().is_material({24.5, 15, -1}));
    EXPECT_FALSE(session.stock().is_material({23.5, 15, -1}));
}

TEST(MillSession, takes_the_engagement_that_the_job_prescribes) {
    MillSetup s = setup_of(cutter(CutterKind::flat, 12), {{0, 0, -10}, {40, 30, 0}}, 0.5,
                           {feed({-10, 15, -1}, {50, 15, -1})});
    s.engagement = PrescribedEngagement{0, pi / 2, 5};
    MillSession session(std::move(s), serial_for);
    int rows = 0;
    ASSERT_TRUE(session.run({[&](const milling::CutRow& row, const milling::RowForce&) {
                                 ++rows;
                                 EXPECT_NEAR(milling::hull(row.engagement).exit_rad, pi / 2, 1e-11);
                                 EXPECT_NEAR(milling::hull(row.engagement).axial_depth_mm, 5, 1e-12);
                             },
                             {}}));
    EXPECT_GT(rows, 50);
}

TEST(MillSession, gives_the_same_bits_on_one_thread_and_on_two) {
    const auto run = [](ParallelFor loop) {
        std::vector<motion::Move> moves;
        for (int n = 0; n < 40; ++n) moves.push_back(feed({1.0 * n, 5, -1}, {1.0 * n + 1, 20, -1.5}));
        MillSession session(setup_of(cutter(CutterKind::bull, 6, 3), {{0, 0, -5}, {40, 30, 0}}, 0.2, moves),
                            std::move(loop));
        std::vector<double> numbers;
        EXPECT_TRUE(session.run({[&](const milling::CutRow& row, const milling::RowForce& force) {
                                     numbers.push_back(row.start_s);
                                     numbers.push_back(force.peaks.peak_xy_n);
                                     numbers.push_back(row.removed_mm3);
                                 },
                                 {}}));
        return numbers;
    };
    const auto two = [](std::size_t count, const std::function<void(std::size_t)>& body) {
        std::thread other([&] {
            for (std::size_t n = 1; n < count; n += 2) body(n);
        });
        for (std::size_t n = 0; n < count; n += 2) body(n);
        other.join();
    };
    EXPECT_EQ(run(serial_for), run(two));
}

TEST(MillSession, stops_when_told_to) {
    std::vector<motion::Move> moves(2000, feed({-10, 15, -3}, {50, 15, -3}));
    MillSession session(setup_of(cutter(CutterKind::flat, 8), {{0, 0, -10}, {40, 30, 0}}, 0.5, moves),
                        serial_for);
    EXPECT_FALSE(session.run({{}, [](double) { return false; }}));
}

}  // namespace
}  // namespace tribo::session
