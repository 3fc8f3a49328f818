// SPDX-License-Identifier: MIT
#include "session/audit/auditor.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include "session/audit/audited_cut.hpp"
#include "session/kept_rows.hpp"

namespace tribo::session {
namespace {

constexpr double kPi = 3.14159265358979;

TEST(Auditor, finds_the_loads_of_a_slot_in_closed_form) {
    const AuditedCut cut = audited(slot_setup(), {});
    ASSERT_EQ(cut.lines.size(), 1u);
    const LoadTally& line = cut.lines[0];
    EXPECT_EQ(line.line, 7);
    const double force = kSlotKtc * kSlotDepth * 0.1;
    EXPECT_NEAR(line.of(LoadKind::force).value, force, 1e-3 * force);
    EXPECT_NEAR(line.of(LoadKind::torque).value, 5e-3 * force, 5e-6 * force);
    // The mean of a half sine over a turn is a pi-th.
    EXPECT_NEAR(line.of(LoadKind::power).value, 5e-3 * force / kPi * 2 * kPi * kSlotRpm / 60, 0.1);
    // It acts half way up the depth on a bar of 8 mm that is clamped at 20 mm.
    EXPECT_NEAR(line.of(LoadKind::stress).value, force * 32 * 19 / (kPi * 512), 0.1);
    const double inertia = kPi / 64 * std::pow(8.0, 4);
    const double yield = ((8000 - 1) / 3.0 - (400 - 1) / 2.0) / (600e3 * inertia);
    EXPECT_NEAR(line.of(LoadKind::deflection).value, force * yield, 1e-3 * force * yield);
    EXPECT_NEAR(line.of(LoadKind::chip).value, 0.1, 1e-9);
    EXPECT_NEAR(line.feed_mm, 50, 1e-9);
    EXPECT_NEAR(line.feed_s, 5, 1e-9);
    // The rim meets the block 5 mm before its centre does; the front leaves it with the centre.
    EXPECT_NEAR(line.cutting_s, 3.5, 0.05);
    EXPECT_EQ(line.entries, 1);
    EXPECT_NEAR(cut.audit.air_share(), 0.3, 0.01);
}

TEST(Auditor, follows_each_line_with_the_largest_values_of_its_rows) {
    MillSetup setup = slot_setup();
    setup.engagement.reset();
    setup.moves.clear();
    setup.cutter_of_move.clear();
    setup.rpm_of_move.clear();
    // Short moves that share rows, and long ones.
    Vec3 at{-10, 0, -2};
    for (int n = 0; n < 60; ++n) {
        const Vec3 to = at + Vec3{n < 40 ? 0.3 : 2.5, n % 7 == 0 ? 0.2 : 0, 0};
        motion::Move move = straight_cut(at, to, n % 5 == 0 ? 500 : 900);
        move.line = 10 + n;
        add_cut(setup, move);
        at = to;
    }
    std::vector<KeptRow> rows;
    {
        MillSetup again = slot_setup();
        again.engagement.reset();
        again.moves = setup.moves;
        again.cutter_of_move = setup.cutter_of_move;
        again.rpm_of_move = setup.rpm_of_move;
        MillSession session(std::move(again), serial_for);
        session.run(keep_rows(rows));
    }
    const AuditedCut cut = audited(std::move(setup), {});
    ASSERT_EQ(cut.lines.size(), 60u);
    std::size_t cutting = 0;
    for (const LoadTally& line : cut.lines) {
        double force = 0, torque = 0, chip = 0;
        for (const KeptRow& kept : rows) {
            if (kept.row.end_s <= line.start_s + 1e-9 || kept.row.start_s >= line.end_s - 1e-9) continue;
            force = std::max(force, kept.force.peaks.peak_force_n);
            torque = std::max(torque, std::abs(kept.force.peaks.peak_torque_nmm));
            chip = std::max(chip, kept.force.chip_mm);
        }
        EXPECT_EQ(line.of(LoadKind::force).value, force) << line.line;
        EXPECT_EQ(line.of(LoadKind::torque).value, 1e-3 * torque) << line.line;
        EXPECT_EQ(line.of(LoadKind::chip).value, chip) << line.line;
        if (force > 0) ++cutting;
    }
    EXPECT_GT(cutting, 20u);
    double feed_s = 0;
    for (const LoadTally& line : cut.lines) feed_s += line.feed_s;
    EXPECT_NEAR(feed_s, cut.audit.feed_s, 1e-9);
    EXPECT_NEAR(cut.audit.feed_s, cut.audit.duration_s, 1e-9);
}

TEST(Auditor, measures_the_way_down_into_material) {
    MillSetup setup = slot_setup();
    setup.engagement.reset();
    setup.moves = {straight_cut({5, 0, 1}, {15, 0, -9}, 300)};
    setup.moves[0].line = 4;
    const AuditedCut cut = audited(std::move(setup), {});
    EXPECT_NEAR(cut.lines.at(0).plunge_deg, 45, 1e-6);
}

TEST(Auditor, keeps_the_worst_lines_in_order) {
    MillSetup setup = slot_setup();
    setup.moves.clear();
    setup.cutter_of_move.clear();
    setup.rpm_of_move.clear();
    for (int n = 0; n < 80; ++n) {
        motion::Move move =
            straight_cut({0.3 * n, 0, -2}, {0.3 * (n + 1), 0, -2}, 200 + 37 * ((n * 29) % 80));
        move.line = n + 1;
        add_cut(setup, move);
    }
    const AuditedCut cut = audited(std::move(setup), {.force_n = 100});
    ASSERT_EQ(cut.audit.worst.size(), kWorstLines);
    for (std::size_t n = 1; n < kWorstLines; ++n) {
        const auto ratio = [&](std::size_t line) {
            return cut.audit.worst[line].of(*cut.audit.worst[line].worst()).ratio;
        };
        EXPECT_GE(ratio(n - 1), ratio(n));
    }
    EXPECT_EQ(cut.audit.line_count, 80u);
}

TEST(SpindleAt, is_linear_between_points_and_holds_the_torque_below_and_the_ends_above) {
    const std::vector<job::SpindlePoint> curve{{1000, 100, 1}, {3000, 300, 0.5}};
    EXPECT_EQ(spindle_at(curve, 2000).power_w, 200);
    EXPECT_EQ(spindle_at(curve, 2000).torque_nm, 0.75);
    EXPECT_EQ(spindle_at(curve, 500).power_w, 50);
    EXPECT_EQ(spindle_at(curve, 500).torque_nm, 1);
    EXPECT_EQ(spindle_at(curve, 9000).power_w, 300);
}

}  // namespace
}  // namespace tribo::session
