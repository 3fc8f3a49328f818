// SPDX-License-Identifier: MIT
// Rows of five-axis programs against flutes stepped in time (flute_stepping.hpp).
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>

#include "field/shape/box_shape.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/moves.hpp"
#include "session/cut/mill_session.hpp"
#include "session/flute_stepping.hpp"

namespace tribo::session {
namespace {

using milling::Cutter;
using milling::CutterKind;
using std::numbers::pi;

constexpr double kRpm = 6000;
constexpr Box3 kBlock{{0, 0, -12}, {40, 30, 0}};

Cutter flat(int flutes, double helix, double diameter = 10) {
    Cutter c;
    c.kind = CutterKind::flat;
    c.diameter_mm = diameter;
    c.flutes = flutes;
    c.helix_deg = helix;
    return c;
}
Cutter ball(int flutes, double helix, double diameter = 10) {
    Cutter c = flat(flutes, helix, diameter);
    c.kind = CutterKind::ball;
    return c;
}
Cutter bull(int flutes, double helix, double corner, double diameter = 10) {
    Cutter c = flat(flutes, helix, diameter);
    c.kind = CutterKind::bull;
    c.corner_mm = corner;
    return c;
}
Cutter with_runout(Cutter c, double mm, double degrees) {
    c.runout_mm = mm;
    c.runout_deg = degrees;
    return c;
}
Cutter with_pitch(Cutter c, std::vector<double> degrees) {
    c.pitch_deg = std::move(degrees);
    return c;
}

// Unit axis that leans `lead` degrees towards +x, then `tilt` degrees towards +y.
Vec3 leaning(double lead, double tilt) {
    const double a = lead * pi / 180, b = tilt * pi / 180;
    return {std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b)};
}

motion::Move move(Vec3 from, Vec3 to, Vec3 axis_from, Vec3 axis_to, double feed, double seconds = 0) {
    motion::Move m;
    m.start = {from, axis_from};
    m.end = {to, axis_to};
    m.feed_mm_per_min = feed;
    m.duration_s = seconds;
    m.line = 1;
    return m;
}
motion::Move straight(Vec3 from, Vec3 to, Vec3 axis, double feed = 600) {
    return move(from, to, axis, axis, feed);
}

struct Row {
    TurnOfForce force;
    double middle_s = 0;
};

// The row of the session that holds that time.
std::optional<Row> row_at(const Cutter& cutter, const std::vector<motion::Move>& moves, double time_s,
                          double cell, const Box3& block = kBlock) {
    MillSetup s;
    s.cutters = {cutter};
    s.coefficients = milling::find_material("al7075-t6")->coefficients;
    s.blank = std::make_unique<field::BoxShape>(block);
    s.blank_volume_mm3 = block.volume();
    s.cell_mm = cell;
    s.timing.max_axis_rad_per_s = 100;  // each move takes the time that its feed asks for
    for (const motion::Move& m : moves) {
        for (const motion::Move& piece : motion::to_elementary(m)) {
            s.moves.push_back(piece);
            s.cutter_of_move.push_back(0);
            s.rpm_of_move.push_back(kRpm);
        }
    }
    MillSession session(std::move(s), serial_for);
    std::optional<Row> found;
    session.run({[&](const milling::CutRow& row, const milling::RowForce& force) {
                     if (time_s < row.start_s || time_s >= row.end_s) return;
                     const milling::ForcePeaks& p = force.peaks;
                     found = Row{{p.mean_n, p.peak_n, p.peak_xy_n, p.mean_torque_nmm, p.peak_torque_nmm},
                                 row.start_s + 0.5 * row.duration_s()};
                 },
                 {}});
    return found;
}

// Shares of the largest component of the mean, of the peaks, of the torques.
void expect_close(const TurnOfForce& a, const TurnOfForce& b, double share, const char* name) {
    const auto largest = [](Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(a.mean_n[k], b.mean_n[k], share * largest(b.mean_n)) << name << " mean " << k;
        EXPECT_NEAR(std::abs(a.peak_n[k]), std::abs(b.peak_n[k]), share * largest(b.peak_n))
            << name << " peak " << k;
    }
    EXPECT_NEAR(a.peak_xy_n / b.peak_xy_n, 1, share) << name;
    EXPECT_NEAR(a.mean_torque_nmm / b.mean_torque_nmm, 1, share) << name;
    EXPECT_NEAR(a.peak_torque_nmm / b.peak_torque_nmm, 1, share) << name;
}

struct Case {
    const char* name;
    Cutter cutter;
    std::vector<motion::Move> moves;
    double time_s;
    double height_mm = 6;  // nothing cuts higher up
};

std::vector<Case> cases() {
    std::vector<Case> c;
    // Slots with leads and tilts of both signs, 600 mm/min.
    const auto slot = [&](const char* name, Cutter cutter, double lead, double tilt, double z,
                          double rise = 0) {
        c.push_back({name,
                     std::move(cutter),
                     {straight({-10, 15, z}, {30, 15, z + rise}, leaning(lead, tilt))},
                     3.02,
                     4.5});
    };
    slot("flat, leads 15", flat(2, 30), 15, 0, -1);
    slot("flat, leads -5", flat(2, 30), -5, 0, -2);
    slot("flat, straight flutes, leads 10", flat(1, 0), 10, 0, -2);
    slot("bull, leads -4 tilts 6", bull(2, -30, 1), -4, 6, -2);
    slot("flat, left-hand, leads -4", flat(2, -30), -4, 0, -2);
    slot("ball, leads -20", ball(2, 0), -20, 0, -2);
    slot("flat ramp down, leads 3", flat(2, 30), 3, 0, 0, -4);
    slot("bull ramp up, tilts 10", bull(4, 30, 2), 0, 10, -5, 4);
    slot("ball ramp down, leads -10", ball(4, 30), -10, 0, 0, -3);
    slot("bull, run-out, leads 8", with_runout(bull(3, 30, 2), 0.01, 40), 8, 0, -2);
    slot("flat, uneven pitch, leads -3", with_pitch(flat(3, 30), {110, 125, 125}), -3, 0, -2);
    slot("flat, leads -2.5 tilts -2.3", flat(3, 0), -2.5, -2.3, -4);
    slot("flat, tilts -20", flat(4, 30), 0, -20, -1);
    slot("flat, left-hand, leads -8", flat(3, -30), -8, 0, -2);
    slot("bull, leads 10 tilts -10", bull(3, 30, 2), 10, -10, -2);
    slot("ball, tilts 30", ball(2, 30), 0, 30, -2);
    slot("ball, left-hand, leads 15 tilts 5", ball(2, -30), 15, 5, -2);
    slot("ball of 3 flutes, leads 25", ball(3, 30), 25, 0, -2);
    slot("flat, tilts 20", flat(2, 30), 0, 20, -1);
    // Half of the cutter beside the block.
    c.push_back({"flat plunge half in, leads 10",
                 flat(2, 30),
                 {straight({20, 0, 3}, Vec3{20, 0, 3} - 8 * leaning(10, 0), leaning(10, 0), 300)},
                 1.31});
    c.push_back({"bull plunge half in, tilts 15",
                 bull(3, 30, 2),
                 {straight({0, 15, 4}, Vec3{0, 15, 4} - 9 * leaning(5, 15), leaning(5, 15), 300)},
                 1.41});
    // The axis turns while the tip stands, after a slot.
    const auto pivot = [&](const char* name, Cutter cutter, double z, Vec3 from, Vec3 to) {
        c.push_back(
            {name,
             std::move(cutter),
             {straight({-10, 15, z}, {20, 15, z}, from), move({20, 15, z}, {20, 15, z}, from, to, 0, 2)},
             4.03,
             6.5});
    };
    pivot("flat pivot, tip stands", flat(2, 30), -4, leaning(0, 0), leaning(20, 0));
    pivot("ball pivot", ball(2, 30), -5, leaning(0, -10), leaning(15, 10));
    pivot("bull pivot sideways", bull(2, -30, 2), -5, leaning(5, 0), leaning(5, 25));
    pivot("flat pivot, back and aside", flat(2, 30), -4, leaning(0, 0), leaning(-20, 5));
    // The axis turns while the tip creeps.
    const auto fan = [&](const char* name, Cutter cutter, Vec3 from, Vec3 to, double z, Vec3 creep) {
        c.push_back({name,
                     std::move(cutter),
                     {straight({-10, 15, z}, {20, 15, z}, from),
                      move({20, 15, z}, Vec3{20, 15, z} + creep, from, to, 0, 2)},
                     4.03,
                     9});
    };
    fan("flat fan, straight flutes", flat(4, 0), leaning(0, 0), leaning(15, 0), -4, {1, 0, 0});
    fan("flat fan", flat(2, 30), leaning(0, 0), leaning(15, 0), -4, {1, 0, 0});
    fan("bull fan, sinks", bull(3, 30, 1.5), leaning(0, 5), leaning(20, -5), -3, {2, 0, -0.5});
    fan("ball fan", ball(2, -30), leaning(10, 0), leaning(-10, 10), -6, {1, 1, 0});
    // Flank milling: a long cut whose axis turns all the way.
    c.push_back({"flank, axis turns",
                 flat(4, 30),
                 {move({-10, -3, -6}, {40, -3, -7}, leaning(0, 0), leaning(5, 12), 1200)},
                 1.27,
                 9});
    return c;
}

TEST(ForceBySteps, five_axis_rows_are_those_of_flutes_stepped_in_time) {
    for (const Case& c : cases()) {
        const std::optional<Row> row = row_at(c.cutter, c.moves, c.time_s, 0.2);
        ASSERT_TRUE(row) << c.name;
        const FluteStepping steps(c.cutter, milling::find_material("al7075-t6")->coefficients, kBlock,
                                  c.moves, kRpm);
        SteppingOptions options;
        options.height_mm = c.height_mm;
        const TurnOfForce expected = steps.turn_at(row->middle_s, options);
        expect_close(row->force, expected, 0.03, c.name);
    }
}

TEST(ForceBySteps, bottom_edges_are_those_of_1440_angles_and_200_radii) {
    Cutter cored = flat(4, 30, 12);
    cored.core_mm = 3;
    const auto plunge = [](Vec3 tip) { return straight(tip, tip - Vec3{0, 0, 6}, {0, 0, 1}, 300); };
    const auto leaning_back = [](double lead, double tilt, double z) {
        return straight({-10, 15, z}, {30, 15, z}, leaning(lead, tilt));
    };
    const Case kBottom[] = {
        {"plunge, half in", flat(2, 30), {plunge({20, 0, 2})}, 0.81},
        {"plunge, a corner of the block in", cored, {plunge({40, 30, 2})}, 0.81},
        {"leads -7", flat(3, 30), {leaning_back(-7, 0, -1)}, 3.02},
        {"leads -2", flat(2, 30), {leaning_back(-2, 0, -1)}, 3.02},
    };
    for (const Case& c : kBottom) {
        const std::optional<Row> row = row_at(c.cutter, c.moves, c.time_s, 0.2);
        ASSERT_TRUE(row) << c.name;
        const FluteStepping steps(c.cutter, milling::find_material("al7075-t6")->coefficients, kBlock,
                                  c.moves, kRpm);
        const TurnOfForce expected =
            steps.turn_at(row->middle_s,
                          {.angles = 1440, .lateral = 120, .bottom = 200, .height_mm = 4, .history_mm = 0.2});
        expect_close(row->force, expected, 0.02, c.name);
    }
}

}  // namespace
}  // namespace tribo::session
