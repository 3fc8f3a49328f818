// SPDX-License-Identifier: MIT
// Power is true to the metal: in any cut the shear work is ktc times the volume that was fed away.
#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "milling/tool/cutter_shape.hpp"
#include "session/block_setup.hpp"
#include "session/cut/mill_warnings.hpp"
#include "session/random_cut.hpp"

namespace tribo::session {
namespace {

// The rows of a bore narrower than two cutters pass each place several times.
constexpr double kShare = 0.01, kShareOfBores = 0.02, kShareOfFewRows = 0.03;
constexpr std::size_t kFewRows = 20;
// Of less the grid knows the volume too roughly.
constexpr double kEnoughCells = 300;

struct Outcome {
    MillTotals totals;
    double rows_mm3 = 0;
    bool silent_where_nothing_goes = true;
};

Outcome mill(MillSetup setup) {
    MillSession session(std::move(setup), serial_for);
    Outcome out;
    session.run({[&](const milling::CutRow& row, const milling::RowForce& force) {
                     out.rows_mm3 += row.removed_mm3;
                     if (row.chip_mm3 == 0 && force.peaks.peak_force_n != 0)
                         out.silent_where_nothing_goes = false;
                 },
                 {}});
    out.totals = session.totals();
    return out;
}

// The same cuts each time: of all that random_cut() draws one in two hundred still misses the bound.
constexpr std::uint64_t kCuts = 240;

TEST(EnergyBalance, holds_for_random_cutters_motions_and_stocks) {
    for (std::uint64_t seed = 0; seed < kCuts; ++seed) {
        RandomCut cut = random_cut(seed);
        const double cell = cut.setup.cell_mm;
        const Outcome out = mill(std::move(cut.setup));
        EXPECT_TRUE(out.silent_where_nothing_goes) << cut.words;
        const MillTotals& t = out.totals;
        if (t.fed_mm3 < kEnoughCells * cell * cell * cell) continue;
        const double usual = cut.motion == CutMotion::bore ? kShareOfBores : kShare;
        const double share = t.rows < kFewRows ? kShareOfFewRows : usual;
        ASSERT_TRUE(t.energy_balance) << cut.words;
        EXPECT_NEAR(*t.energy_balance, 1, share) << seed << ": " << cut.words;
        EXPECT_NEAR(out.rows_mm3 / t.removed_mm3, 1, share) << seed << ": " << cut.words;
    }
}

// What a plunge leaves behind it ends the cut, wherever in its last row that is. The torque is even all the
// way: ktc A f / 2 pi.
TEST(EnergyBalance, a_plunge_through_a_plate_cuts_as_long_as_the_plate_is_thick) {
    const double ktc = 2000, diameter = 1, feed = 60, rpm = 6000;
    for (const double depth : {1.05, 1.15, 1.3}) {
        MillSetup s = block_setup({{-2, -2, -1}, {2, 2, 0}}, {.diameter_mm = diameter, .length_mm = 4}, 0.05);
        s.coefficients = {ktc, 600, 300, 0, 0, 0};
        add_cut(s, straight_cut({0, 0, 0.5}, {0, 0, -depth}, feed), rpm);
        MillSession session(std::move(s), serial_for);
        const double torque = ktc * math::kPi / 4 * diameter * diameter * feed / rpm / math::kTwoPi;
        double seconds = 0;
        session.run({[&](const milling::CutRow& row, const milling::RowForce& force) {
                         if (row.chip_mm3 == 0) return;
                         seconds += row.length_mm / (feed / 60);
                         EXPECT_NEAR(force.peaks.mean_torque_nmm / torque, 1, 0.01) << depth;
                     },
                     {}});
        EXPECT_NEAR(seconds / (1 / (feed / 60)), 1, 0.005) << depth;
    }
}

// A disc that sinks as it goes along a wall takes the band between its faces, and a lens at each end of the
// way: nothing of what is above it.
TEST(EnergyBalance, a_disc_that_sinks_takes_nothing_above_it) {
    const double radius = 20, thickness = 3, way = 40, width = 10;
    const milling::Cutter disc{
        .diameter_mm = 2 * radius, .length_mm = thickness, .stickout_mm = 80, .shank_mm = 10};
    // Of the half plane of the wall, from its surface to the rim.
    double chords = 0;
    constexpr int kSteps = 10'000;
    for (int n = 0; n < kSteps; ++n) {
        const double y = radius - width + width * (n + 0.5) / kSteps;
        chords += 2 * std::sqrt(radius * radius - y * y) * width / kSteps;
    }
    for (const double slope : {0.0, 0.05, 0.2, -0.2}) {
        MillSetup s = block_setup({{-20, 10, -40}, {20, 50, 40}}, disc, 0.4);
        s.coefficients = {2000, 600, 300, 0, 0, 0};
        const double reach = 0.5 * way + radius + 5;
        add_cut(s, straight_cut({-reach, 0, slope * reach}, {reach, 0, -slope * reach}, 600));
        const Outcome out = mill(std::move(s));
        const double expected = way * (thickness * width + std::abs(slope) * chords);
        EXPECT_NEAR(out.totals.removed_mm3 / expected, 1, 0.01) << slope;
        // It has no edges on its top, which would cut on the way up.
        if (slope < 0) continue;
        EXPECT_NEAR(*out.totals.energy_balance, 1, kShare) << slope;
    }
}

// A long way down through air, and only the last of it in metal.
TEST(EnergyBalance, a_plunge_that_only_just_touches_has_rows) {
    for (const double depth : {0.01, 0.2, 0.7}) {
        const Vec3 from{10, 10, 3.1}, to{10, 10, -depth};
        MillSetup s = block_setup({{0, 0, -5}, {20, 20, 0}}, {.diameter_mm = 6}, 0.1);
        s.coefficients = {2000, 600, 300, 0, 0, 0};
        motion::Move plunge = straight_cut(from, to, 60);
        plunge.line = 1;
        add_cut(s, plunge);
        MillSession session(std::move(s), serial_for);
        double seconds = 0, volume = 0;
        session.run({[&](const milling::CutRow& row, const milling::RowForce&) {
                         seconds += row.duration_s();
                         volume += row.removed_mm3;
                     },
                     {}});
        const double row_mm = 0.5;
        EXPECT_NEAR(seconds, depth, row_mm / 512) << depth;  // at 1 mm/s
        EXPECT_NEAR(volume, math::kPi * 9 * depth, math::kPi * 9 * row_mm / 512) << depth;
        EXPECT_NEAR(*session.totals().energy_balance, 1, 0.03) << depth;
    }
}

// Of a plunge the core takes its share of the circle without a force: torque and thrust are those of the
// edges outside of it, ktc f (R^2 - r^2) / 2 and krc f (R - r) with f per turn, and no row makes up for it.
TEST(EnergyBalance, leaves_out_what_the_core_moves_into) {
    for (const milling::CutterKind kind : {milling::CutterKind::flat, milling::CutterKind::drill}) {
        for (const double core : {0.0, 2.0, 5.0, 8.0, 9.5}) {
            milling::Cutter cutter{.kind = kind, .diameter_mm = 10, .flutes = 3, .core_mm = core};
            if (kind == milling::CutterKind::drill) {
                cutter.point_deg = 120;
                cutter.length_mm = 0;
                ASSERT_TRUE(milling::make_profile(cutter));
            }
            MillSetup s = block_setup({{0, 0, -12}, {40, 40, 0}}, cutter, 0.2);
            s.coefficients = {1000, 300, 200, 0, 0, 0};
            motion::Move plunge = straight_cut({20, 20, 0.5}, {20, 20, -9}, 600);
            plunge.line = 7;
            add_cut(s, plunge);
            double torque_nmm = 0, least = 1, most = 1, core_mm3 = 0, per_turn_mm = 0;
            MillSession session(std::move(s), serial_for);
            session.run({[&](const milling::CutRow& row, const milling::RowForce& force) {
                             least = std::min(least, row.reconciled);
                             most = std::max(most, row.reconciled);
                             core_mm3 += row.core_mm3;
                             torque_nmm = std::max(torque_nmm, force.peaks.mean_torque_nmm);
                             per_turn_mm = row.feed.down_mm * cutter.flutes;
                         },
                         {}});
            const double share = 1 - core * core / 100, missing = session.totals().removed_mm3 * (1 - share);
            EXPECT_NEAR(torque_nmm, 1000 * per_turn_mm * 25 * share / 2, 0.01 * torque_nmm) << core;
            // The point of the drill does not reach its whole diameter at once.
            const double slack = kind == milling::CutterKind::drill ? 0.12 : 0.01;
            EXPECT_NEAR(*session.totals().energy_balance, share, slack) << core;
            EXPECT_NEAR(core_mm3, missing, slack * session.totals().removed_mm3) << core;
            EXPECT_GT(least, 0.97) << core;
            EXPECT_LT(most, 1.03) << core;
            const Warnings said = warnings_of(session.totals(), "job.toml", "job.nc");
            EXPECT_EQ(core > 0, !said.empty() && said[0].text.find("core_mm") != std::string::npos) << core;
        }
    }
}

// The blank stands between two of the even places of the cutter's circle.
TEST(EnergyBalance, holds_for_face_mills_that_are_much_wider_than_the_blank) {
    for (const double diameter : {80.0, 200.0, 500.0}) {
        for (const double width : {5.0, 20.0}) {
            for (const double offset : {0.0, 0.013, 0.0246, 0.031, 0.1}) {
                MillSetup s =
                    block_setup({{0, 0, -10}, {60, width, 0}}, {.diameter_mm = diameter, .flutes = 8}, 0.5);
                const double y = 0.5 * width + offset * diameter, before = -0.5 * diameter - 2;
                add_cut(s, straight_cut({before, y, -2}, {before + 40, y, -2}, 400), 600);
                const Outcome out = mill(std::move(s));
                ASSERT_TRUE(out.totals.energy_balance) << diameter << " " << width << " " << offset;
                EXPECT_NEAR(*out.totals.energy_balance, 1, kShare)
                    << diameter << " " << width << " " << offset;
            }
        }
    }
}

TEST(EnergyBalance, nothing_is_felt_where_nothing_is_left_to_cut) {
    // The same moves once more through what they have left.
    for (std::uint64_t seed = 0; seed < 36; ++seed) {
        RandomCut cut = random_cut(seed);
        if (turns(cut.motion)) continue;  // a sweep that turns is met again within its own tolerance
        const double cell = cut.setup.cell_mm, first_mm3 = mill(random_cut(seed).setup).totals.removed_mm3;
        if (first_mm3 < kEnoughCells * cell * cell * cell) continue;
        cut.setup.earlier.push_back(planned_cuts(cut.setup));
        const Outcome again = mill(std::move(cut.setup));
        EXPECT_EQ(again.totals.rows, 0u) << cut.words;
        EXPECT_EQ(again.totals.work_j, 0) << cut.words;
        // The grid rounds the distances that it keeps.
        EXPECT_NEAR(again.totals.removed_mm3 / first_mm3, 0, 2e-4) << cut.words;
    }
}

}  // namespace
}  // namespace tribo::session
