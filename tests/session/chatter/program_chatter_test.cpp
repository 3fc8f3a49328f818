// SPDX-License-Identifier: MIT
// The chatter of all rows of a program: against one simulation of the same cut, turned, tilted, with gaps.
#include "session/chatter/program_chatter.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "session/chatter/row_stability.hpp"
#include "session/chatter/simulated_cut.hpp"

namespace tribo::session {
namespace {

constexpr double kRpm = 8000, kFeedMm = 0.1, kPi = std::numbers::pi;

// That of the benchmark: a slot of 0.2 mm is stable, one of 1 mm is not.
dynamics::Mode soft(const Vec3& direction) {
    return {direction, 922, 0.011, 1340.05};
}
dynamics::Mode stiff(const Vec3& direction, dynamics::ModeOn on = dynamics::ModeOn::tool) {
    return {direction, 922, 0.03, 13'400, on};
}

MillSetup program_setup(const std::vector<dynamics::Mode>& modes, double helix_deg = 30) {
    MillSetup setup;
    setup.cutters = {{.diameter_mm = 10, .flutes = 2, .helix_deg = helix_deg, .length_mm = 20}};
    setup.coefficients = {600, 200, 0, 0, 0, 0};
    setup.modes_of_cutter = {modes};
    setup.moves.resize(1);
    setup.cutter_of_move = {0};
    setup.rpm_of_move = {kRpm};
    return setup;
}

// A slot, `depth_mm` deep, with x along `feed` across the axis.
milling::CutRow program_row(double start_s, double end_s, double depth_mm, Vec3 feed = {1, 0, 0},
                            Vec3 axis = {0, 0, 1}) {
    milling::CutRow row;
    row.line = 1;
    row.start_s = start_s;
    row.end_s = end_s;
    row.spindle_rpm = kRpm;
    row.phase_rad = row.spindle_rad_per_s() * start_s;
    row.pose.frame = milling::tool_frame(axis, feed, feed);
    row.feed.across_mm = kFeedMm;
    row.engagement.bands = {{0, depth_mm, 0, kPi}};
    return row;
}

std::vector<double> peaks(const std::vector<dynamics::Mode>& modes,
                          const std::vector<milling::CutRow>& rows) {
    const MillSetup setup = program_setup(modes);
    RowSimulation simulation(setup);
    std::vector<double> largest;
    for (const milling::CutRow& row : rows) largest.push_back(simulation.run(row).value());
    return largest;
}

// However the program cuts its path into rows, the tool vibrates as in one steady cut.
TEST(RowSimulation, of_many_rows_is_that_of_one_cut) {
    const std::vector<dynamics::Mode> modes{stiff({1, 0, 0}), stiff({0.3, 1, 0})};
    const MillSetup setup = program_setup(modes);
    SteadyCut cut;
    cut.cutter = setup.cutters[0];
    cut.coefficients = setup.coefficients;
    cut.modes = modes;
    cut.bands = {{0, 0.6, 0, kPi}};
    cut.axial_depth_mm = 0.6;
    cut.feed_per_tooth_mm = kFeedMm;
    const SimulationPeaks known =
        simulate(cut, {kRpm, 0.6, 30}, [](std::size_t, const dynamics::VibrationSample&) { return true; });
    std::mt19937 random(7);
    std::uniform_real_distribution<double> seconds(1e-6, 0.02);
    const double all_s = 30 * 60 / kRpm;
    std::vector<milling::CutRow> rows;
    for (double t = 0; t < all_s;) {
        const double end = std::min(all_s, t + seconds(random));
        rows.push_back(program_row(t, end, 0.6));
        t = end;
    }
    ASSERT_GT(rows.size(), 20u);
    EXPECT_NEAR(std::ranges::max(peaks(modes, rows)), known.displacement_mm, 1e-9);
}

// A cut that turns with its modes, and one of a tilted tool, are the same cut seen from elsewhere.
TEST(RowSimulation, knows_no_direction_of_the_stock) {
    const auto rows = [](const Vec3& feed, const Vec3& axis) {
        std::vector<milling::CutRow> all;
        for (int n = 0; n < 20; ++n)
            all.push_back(program_row(0.01 * n, 0.01 * (n + 1), 0.4 + 0.02 * n, feed, axis));
        return all;
    };
    const std::vector<double> known =
        peaks({stiff({1, 0.2, 0.1}), stiff({0, 1, 0}, dynamics::ModeOn::part)}, rows({1, 0, 0}, {0, 0, 1}));
    const double turn = 2.2, s = std::sin(turn), c = std::cos(turn);
    const std::vector<double> turned =
        peaks({stiff({c - 0.2 * s, s + 0.2 * c, 0.1}), stiff({-s, c, 0}, dynamics::ModeOn::part)},
              rows({c, s, 0}, {0, 0, 1}));
    // Tilted about y: tool modes go with the axis, those of the part stay.
    const double tilt = 0.8, ts = std::sin(tilt), tc = std::cos(tilt);
    const std::vector<double> tilted = peaks({stiff({1, 0.2, 0.1}), stiff({0, 1, 0}, dynamics::ModeOn::part)},
                                             rows({tc, 0, -ts}, {ts, 0, tc}));
    // A tool that points up.
    const std::vector<double> upside_down =
        peaks({stiff({1, 0.2, 0.1}), stiff({0, -1, 0}, dynamics::ModeOn::part)}, rows({1, 0, 0}, {0, 0, -1}));
    for (std::size_t n = 0; n < known.size(); ++n) {
        EXPECT_GT(known[n], 1e-3);
        EXPECT_NEAR(turned[n], known[n], 1e-9) << n;
        EXPECT_NEAR(tilted[n], known[n], 1e-9) << n;
        EXPECT_NEAR(upside_down[n], known[n], 1e-9) << n;
    }
}

TEST(RowSimulation, starts_again_after_a_long_gap_and_dies_out_in_a_short_one) {
    const std::vector<dynamics::Mode> modes{soft({1, 0, 0})};
    const double turn_s = 60 / kRpm;  // gaps of whole turns: the same phase
    const std::vector<double> p = peaks(
        modes, {program_row(0, 4 * turn_s, 0.5), program_row(4 * turn_s, 8 * turn_s, 0.5),
                program_row(208 * turn_s, 212 * turn_s, 0.5), program_row(212 * turn_s, 216 * turn_s, 0.5)});
    EXPECT_NEAR(p[0], p[2], 1e-7);
    EXPECT_NEAR(p[1], p[3], 1e-7);

    // Four turns in air: what is left of a vibration is its decay.
    const MillSetup setup = program_setup(modes);
    RowSimulation simulation(setup);
    (void)simulation.run(program_row(0, 8 * turn_s, 1));
    const double before = *simulation.run(program_row(8 * turn_s, 8 * turn_s + 1e-4, 1));
    milling::CutRow air = program_row(12 * turn_s, 12 * turn_s + 1e-4, 1);
    air.engagement.bands.clear();
    const double after = *simulation.run(air);
    const double decay = std::exp(-0.011 * 2 * kPi * 922 * 4 * turn_s);
    EXPECT_LT(after, 1.5 * decay * std::max(before, 0.05));
    EXPECT_GT(after, 0);
}

TEST(RowSimulation, holds_what_moves_farther_than_the_equations_hold) {
    MillSetup setup = program_setup({soft({1, 0, 0})});
    RowSimulation shallow(setup);
    (void)shallow.run(program_row(0, 0.1, 0.2));
    EXPECT_FALSE(shallow.was_held());
    setup.modes_of_cutter[0][0].stiffness_n_per_mm = 20;
    RowSimulation loose(setup);
    EXPECT_DOUBLE_EQ(*loose.run(program_row(0, 0.5, 10)), 1);  // a tenth of the diameter
    EXPECT_TRUE(loose.was_held());
}

// Of two cutters each bends as its own modes say.
TEST(ProgramChatter, knows_the_modes_of_each_cutter) {
    MillSetup setup = program_setup({soft({1, 0, 0})});
    setup.cutters.push_back(setup.cutters[0]);
    setup.modes_of_cutter.push_back({stiff({1, 0, 0})});
    std::vector<RowChatter> found;
    const ParallelFor one_by_one = [](std::size_t count, const std::function<void(std::size_t)>& body) {
        for (std::size_t n = 0; n < count; ++n) body(n);
    };
    ProgramChatter chatter(setup, {}, one_by_one,
                           [&](const milling::CutRow&, const milling::RowForce&, const RowChatter& of_row) {
                               found.push_back(of_row);
                           });
    for (std::size_t n = 0; n < 2; ++n) {
        milling::CutRow row =
            program_row(0.1 * static_cast<double>(n), 0.1 * static_cast<double>(n + 1), 0.2);
        row.cutter = n;
        chatter.add(row, {});
    }
    chatter.finish();
    ASSERT_EQ(found.size(), 2u);
    for (std::size_t n = 0; n < 2; ++n) {
        const milling::EngagementBand slot{0, 0.2, 0, kPi};
        const double known =
            dynamics::stability(setup.modes(n),
                                dynamics::CutFeedback(setup.cutters[n], setup.coefficients, {&slot, 1}, kRpm))
                .multiplier;
        EXPECT_DOUBLE_EQ(found[n].stability->multiplier, known);
    }
    // Ten times as stiff: it moves a tenth, or less.
    EXPECT_LT(*found[1].peak_displacement_mm, 0.2 * *found[0].peak_displacement_mm);
}

// A cut beyond its limit, at a low speed: the spindle that swings calms it down. How the cut comes in rows
// does not matter.
TEST(RowSimulation, follows_a_spindle_whose_speed_varies) {
    constexpr double kSlowRpm = 1500, kDepthMm = 0.45, kAllS = 1.5;
    MillSetup setup = program_setup({soft({1, 0, 0})}, 0);
    setup.rpm_of_move = {kSlowRpm};
    const auto largest_late = [&](int rows) {
        RowSimulation simulation(setup);
        double largest = 0;
        for (int n = 0; n < rows; ++n) {
            milling::CutRow row = program_row(kAllS * n / rows, kAllS * (n + 1) / rows, kDepthMm);
            row.spindle_rpm = kSlowRpm;
            const double peak = simulation.run(row).value();
            if (2 * n >= rows) largest = std::max(largest, peak);
        }
        return largest;
    };
    const double steady = largest_late(60);
    setup.variation = {0.2, 4};
    const double swinging = largest_late(60);
    EXPECT_LT(swinging, 0.5 * steady);
    EXPECT_NEAR(largest_late(77), swinging, 0.02 * swinging);
    setup.variation = {0, 4};
    EXPECT_EQ(largest_late(60), steady);
}

// Rows of all kinds come out in order, with what is missing counted.
TEST(ProgramChatter, gives_every_row_on_and_says_what_is_missing) {
    const std::vector<dynamics::Mode> modes{soft({1, 0, 0})};
    MillSetup setup = program_setup(modes, 0);
    constexpr int kRows = 1300;  // more than two batches
    std::vector<int> lines;
    std::vector<double> multipliers, displacements;
    const auto sink = [&](const milling::CutRow& row, const milling::RowForce&, const RowChatter& chatter) {
        lines.push_back(row.line);
        multipliers.push_back(chatter.stability ? chatter.stability->multiplier : -1);
        displacements.push_back(chatter.peak_displacement_mm.value_or(-1));
    };
    // In any order of the tasks.
    const ParallelFor backwards = [](std::size_t count, const std::function<void(std::size_t)>& body) {
        for (std::size_t n = count; n-- > 0;) body(n);
    };
    ProgramChatter chatter(setup, {}, backwards, sink);
    for (int n = 0; n < kRows; ++n) {
        milling::CutRow row = program_row(0.005 * n, 0.005 * (n + 1), n < 650 ? 0.2 : 1);
        row.line = 1 + n / 10;
        if (n == 5) row.engagement.bands.clear();
        if (n == 6) row.spindle_rpm = 0.01;
        chatter.add(row, {});
    }
    chatter.finish();
    ASSERT_EQ(lines.size(), static_cast<std::size_t>(kRows));
    EXPECT_TRUE(std::ranges::is_sorted(lines));
    const ChatterTotals& totals = chatter.totals();
    EXPECT_EQ(totals.on_bottom.count, 1u);
    EXPECT_EQ(totals.slow.count, 1u);
    EXPECT_EQ(totals.not_simulated.count, 1u);
    EXPECT_EQ(warnings_of(totals, "a.nc").size(), 3u + (totals.held.count > 0 ? 1 : 0));
    for (std::size_t n = 0; n < 20; ++n) EXPECT_EQ(displacements[n] < 0, n == 6) << n;
    // The limit of this slot at 8000 rpm lies between 0.2 and 1 mm (notes of the benchmark).
    EXPECT_EQ(multipliers[5], -1);
    EXPECT_LT(multipliers[100], 1);
    EXPECT_GT(multipliers[700], 1);
    EXPECT_EQ(multipliers[100], multipliers[600]);
    ASSERT_EQ(totals.lines.size(), 65u);
    EXPECT_EQ(totals.lines[0].line, 66);
    EXPECT_DOUBLE_EQ(totals.lines[0].t_s, 3.25);
    EXPECT_DOUBLE_EQ(totals.lines[0].multiplier, multipliers[700]);
    const milling::EngagementBand slot{0, 1, 0, kPi};
    const double known =
        dynamics::stability(modes,
                            dynamics::CutFeedback(setup.cutters[0], setup.coefficients, {&slot, 1}, kRpm))
            .multiplier;
    EXPECT_DOUBLE_EQ(multipliers[700], known);
}

}  // namespace
}  // namespace tribo::session
