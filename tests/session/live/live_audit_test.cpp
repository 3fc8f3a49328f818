// SPDX-License-Identifier: MIT
#include "session/live/live_audit.hpp"

#include <gtest/gtest.h>

#include "session/audit/audit_json.hpp"
#include "session/audit/audited_cut.hpp"

namespace tribo::session {
namespace {

// The slot in four pieces, each a line of its own.
MillSetup slot_in_lines() {
    MillSetup setup = slot_setup();
    setup.moves.clear();
    setup.cutter_of_move.clear();
    setup.rpm_of_move.clear();
    for (int n = 0; n < 4; ++n) {
        const double from = -10 + 12.5 * n;
        motion::Move cut = straight_cut({from, 0, -kSlotDepth}, {from + 12.5, 0, -kSlotDepth}, 600);
        cut.line = 3 + n;
        add_cut(setup, cut, kSlotRpm);
    }
    return setup;
}

job::JobLimits slot_limits() {
    job::JobLimits limits;
    limits.force_n = 150;
    return limits;
}

std::unique_ptr<LiveMill> live_slot(double milled_to_s) {
    const auto input = []() -> Result<LiveInput> {
        LiveInput live(slot_in_lines());
        job::Job job;
        job.limits = slot_limits();
        live.extras.limits = cut_limits(job, live.setup);
        return live;
    };
    auto live = LiveMill::create(input, serial_for);
    (*live)->set_clock(milled_to_s);
    (*live)->tick(0, [] { return true; }, [](auto) {});
    return std::move(*live);
}

double number(const LiveAudit& audit, std::size_t line, std::size_t column) {
    return audit.lines[line * kAuditColumns + column];
}

constexpr std::size_t kForceColumn = 9, kPowerColumn = 11, kChipColumn = 14, kForceRatioColumn = 16;

TEST(LiveAudit, is_that_of_the_whole_program_once_it_is_milled) {
    const LiveAudit live = audit_of(*live_slot(1e9), serial_for);
    const AuditedCut whole = audited(slot_in_lines(), slot_limits());
    std::vector<double> lines;
    const MillSetup setup = slot_in_lines();
    for (const LoadTally& line : whole.lines) append_audit_line(line, setup, lines);
    EXPECT_EQ(live.lines, lines);
    EXPECT_NE(live.json.find("\"sentence\":\"" + whole.verdict.sentence + "\""), std::string::npos);
    EXPECT_NEAR(number(live, 1, kForceRatioColumn), 200.0 / 150, 2e-3);
}

TEST(LiveAudit, counts_nothing_that_is_not_milled_yet) {
    // The slot takes 5 s.
    const std::unique_ptr<LiveMill> mill = live_slot(1.9);
    const double milled_s = mill->session().milled_s();
    ASSERT_LT(milled_s, 3);
    const LiveAudit audit = audit_of(*mill, serial_for);
    ASSERT_EQ(audit.lines.size() % kAuditColumns, 0u);
    const std::size_t lines = audit.lines.size() / kAuditColumns;
    EXPECT_LT(lines, 4u);
    double seconds = 0;
    for (std::size_t n = 0; n < lines; ++n) seconds += number(audit, n, 2);
    EXPECT_NEAR(seconds, milled_s, 1e-9);
}

TEST(LiveAudit, follows_the_overrides_of_the_viewer) {
    const std::unique_ptr<LiveMill> mill = live_slot(1e9);
    const LiveAudit before = audit_of(*mill, serial_for);
    mill->set_change({.feed_factor = 1.5, .speed_factor = 0.75});
    const LiveAudit after = audit_of(*mill, serial_for);
    // Without edge forces all is in proportion to the chip, which is twice as thick; the spindle is slower.
    EXPECT_NEAR(number(after, 1, kForceColumn), 2 * number(before, 1, kForceColumn), 1e-6);
    EXPECT_NEAR(number(after, 1, kChipColumn), 0.2, 1e-9);
    EXPECT_NEAR(number(after, 1, kPowerColumn), 1.5 * number(before, 1, kPowerColumn), 1e-6);
}

TEST(LiveAudit, has_the_band_of_another_material) {
    const std::unique_ptr<LiveMill> mill = live_slot(1e9);
    CutChange change;
    change.coefficients = milling::CuttingCoefficients{.ktc = 2 * kSlotKtc};
    change.force_low_factor = 0.8;
    change.force_high_factor = 1.25;
    mill->set_change(change);
    const LiveAudit audit = audit_of(*mill, serial_for);
    EXPECT_NE(audit.json.find("\"force_band\":[0.8,1.25]"), std::string::npos);
    EXPECT_NEAR(number(audit, 1, kForceRatioColumn), 400.0 / 150, 4e-3);
}

}  // namespace
}  // namespace tribo::session
