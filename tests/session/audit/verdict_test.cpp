// SPDX-License-Identifier: MIT
// Jobs whose outcome is known in closed form. The slot has a largest force of 200 N, a largest torque of 1 N
// m, a mean power of 200 W, a stress of 75.6 N/mm2 and a chip of 0.1 mm (auditor_test).
#include "session/audit/verdict.hpp"

#include <gtest/gtest.h>

#include "session/audit/audited_cut.hpp"

namespace tribo::session {
namespace {

Outcome outcome(MillSetup setup, const job::JobLimits& limits, const AuditFacts& facts = {}) {
    return audited(std::move(setup), limits, facts).verdict.outcome;
}

TEST(Verdict, is_yes_for_a_cut_that_is_within_all_limits) {
    const AuditedCut cut = audited(slot_setup(), {.force_n = 210, .torque_nm = 1.1, .power_w = 220});
    EXPECT_EQ(cut.verdict.outcome, Outcome::within);
    EXPECT_EQ(cut.verdict.sentence,
              "Yes: nothing is over a limit. The force is nearest to its own, 0.95 of it, in line 7.");
    EXPECT_TRUE(cut.verdict.findings.empty());
}

TEST(Verdict, knows_a_cutter_that_breaks) {
    const AuditedCut cut = audited(slot_setup(), {.stress_n_per_mm2 = 70});
    EXPECT_EQ(cut.verdict.outcome, Outcome::over);
    EXPECT_EQ(cut.verdict.sentence,
              "No: line 7, T3: the cutter breaks; the bending stress is 1.1 times its limit.");
}

TEST(Verdict, knows_a_spindle_that_stalls) {
    EXPECT_EQ(outcome(slot_setup(), {.power_w = 190}), Outcome::over);
    EXPECT_EQ(outcome(slot_setup(), {.power_w = 210}), Outcome::within);
    // 2000 W at 60000 rpm are 200 W at 6000 rpm.
    EXPECT_EQ(outcome(slot_setup(), {.spindle = {{60'000, 1900, 2}}}), Outcome::over);
    EXPECT_EQ(outcome(slot_setup(), {.spindle = {{60'000, 2100, 2}}}), Outcome::within);
    EXPECT_EQ(outcome(slot_setup(), {.spindle = {{60'000, 2100, 0.9}}}), Outcome::over);
}

TEST(Verdict, knows_a_force_that_is_too_large_and_a_tool_that_bends_too_far) {
    EXPECT_EQ(outcome(slot_setup(), {.force_n = 199}), Outcome::over);
    EXPECT_EQ(outcome(slot_setup(), {.force_n = 201}), Outcome::within);
    // 200 N on (7999 / 3 - 399 / 2) / (600000 pi / 64 8^4) mm/N: 0.00409 mm.
    EXPECT_EQ(outcome(slot_setup(), {.deflection_mm = 0.00400}), Outcome::over);
    EXPECT_EQ(outcome(slot_setup(), {.deflection_mm = 0.00418}), Outcome::within);
}

TEST(Verdict, knows_teeth_that_rub_and_teeth_that_are_overloaded) {
    // 0.1 mm are four tenths of the rule of thumb of 0.25 mm; six times the feed is sure.
    EXPECT_EQ(outcome(slot_setup(), {}), Outcome::within);
    EXPECT_EQ(outcome(slot_setup(3600), {.stress_n_per_mm2 = 1e4}), Outcome::over);
    const AuditedCut rubs = audited(slot_setup(24), {});  // 0.004 mm
    EXPECT_EQ(rubs.verdict.outcome, Outcome::over);
    EXPECT_NE(rubs.verdict.sentence.find("rub rather than cut"), std::string::npos) << rubs.verdict.sentence;
    EXPECT_EQ(outcome(slot_setup(60), {}), Outcome::undecided);  // 0.01 mm: the rule of thumb itself
    EXPECT_EQ(outcome(slot_setup(60), {.chip_min_mm = 0.009}), Outcome::within);
}

TEST(Verdict, gives_none_where_the_band_of_the_force_spans_the_limit) {
    const auto banded = [] {
        MillSetup setup = slot_setup();
        setup.force_low_factor = 0.5;
        setup.force_high_factor = 2;
        return setup;
    };
    EXPECT_EQ(outcome(banded(), {.force_n = 99}), Outcome::over);
    EXPECT_EQ(outcome(banded(), {.force_n = 410}), Outcome::within);
    for (const double limit : {102.0, 200.0, 390.0}) {
        const AuditedCut cut = audited(banded(), {.force_n = limit});
        EXPECT_EQ(cut.verdict.outcome, Outcome::undecided);
        EXPECT_TRUE(cut.verdict.sentence.starts_with("No verdict: line 7, T3: the force is"))
            << cut.verdict.sentence;
    }
}

TEST(Verdict, gives_none_where_the_band_of_the_strength_does) {
    // 500 to 1000 N/mm2 for carbide: the slot at eight times its feed has 605.
    EXPECT_EQ(outcome(slot_setup(4800), {.chip_max_mm = 1}), Outcome::undecided);
    EXPECT_EQ(outcome(slot_setup(9600), {.chip_max_mm = 2}), Outcome::over);
    EXPECT_EQ(outcome(slot_setup(3600), {.chip_max_mm = 1}), Outcome::within);
}

// The benchmark of the literature (Altintas and Budak 1995): 2 teeth, Ktc 600, Krc 200 N/mm2, a mode along
// the feed; at 8000 rpm a slot is stable up to 0.676 mm.
MillSetup benchmark(double depth_mm) {
    MillSetup setup = slot_setup(1600);
    setup.cutters[0].flutes = 2;
    setup.coefficients = {.ktc = 600, .krc = 200};
    setup.engagement->axial_depth_mm = depth_mm;
    setup.rpm_of_move = {8000};
    setup.modes_of_cutter = {{dynamics::Mode{{1, 0, 0}, 922, 0.011, 1340.05}}};
    return setup;
}

TEST(Verdict, knows_a_cut_that_chatters) {
    const AuditedCut cut = audited(benchmark(0.75), {});
    EXPECT_EQ(cut.verdict.outcome, Outcome::over);
    EXPECT_NE(cut.verdict.sentence.find("the cut chatters"), std::string::npos) << cut.verdict.sentence;
    EXPECT_EQ(outcome(benchmark(0.6), {}), Outcome::within);
    EXPECT_EQ(outcome(benchmark(0.6), {}, {.chatter_probability = 0.3}), Outcome::undecided);
    EXPECT_EQ(outcome(benchmark(0.75), {}, {.chatter_probability = 1.0}), Outcome::over);
}

TEST(Verdict, knows_a_part_out_of_tolerance) {
    EXPECT_EQ(outcome(slot_setup(), {.tolerance_mm = 0.05}, {.gouge_mm = 0.06}), Outcome::over);
    EXPECT_EQ(outcome(slot_setup(), {.tolerance_mm = 0.05}, {.gouge_mm = 0.04}), Outcome::within);
    // Without a tolerance it is not "Yes" that stands beside a gouge.
    EXPECT_EQ(outcome(slot_setup(), {}, {.gouge_mm = 0.009}), Outcome::within);
    const AuditedCut gouged = audited(slot_setup(), {}, {.gouge_mm = 0.06, .gouge_line = 7});
    EXPECT_EQ(gouged.verdict.outcome, Outcome::undecided);
    EXPECT_EQ(
        gouged.verdict.sentence,
        "No verdict: line 7: the part has a gouge of 0.06 mm, and no tolerance_mm says whether it may.");
    EXPECT_EQ(outcome(slot_setup(), {.tolerance_mm = 0.05}, {.left_mm = 0.06, .left_line = 7}),
              Outcome::over);
}

TEST(Verdict, knows_a_collision) {
    MillSetup setup = slot_setup();
    motion::Move back = straight_cut({40, 0, -2}, {-10, 10, -2}, 0);
    back.kind = motion::MoveKind::rapid;
    back.line = 8;
    add_cut(setup, back, kSlotRpm);
    const AuditedCut cut = audited(std::move(setup), {});
    EXPECT_EQ(cut.verdict.outcome, Outcome::over);
    EXPECT_TRUE(cut.verdict.sentence.starts_with("No: line 8: ")) << cut.verdict.sentence;
    EXPECT_EQ(cut.lines.back().collisions, 1);
}

TEST(Verdict, has_nothing_to_judge_where_nothing_is_cut) {
    MillSetup setup = slot_setup();
    setup.moves[0].start.tip_mm.z = setup.moves[0].end.tip_mm.z = 5;
    EXPECT_EQ(outcome(std::move(setup), {}), Outcome::nothing_cut);
}

TEST(Verdict, has_the_bands_of_cases) {
    MillSetup setup = slot_setup();
    setup.force_low_factor = 0.7;
    setup.force_high_factor = 3;
    // The slot has 200 N.
    const AuditedCut cut = audited(std::move(setup), {.force_n = 80}, {}, 1000);
    ASSERT_EQ(cut.verdict.findings.size(), 1u) << cut.verdict.sentence;
    const RatioBand& ratio = *cut.verdict.findings[0].ratio;
    EXPECT_EQ(cut.verdict.findings[0].outcome, Outcome::over);
    EXPECT_NEAR(ratio.low / (2.5 * 0.7), 1, 0.01);
    EXPECT_NEAR(ratio.value, 2.5, 0.01);
    EXPECT_NEAR(ratio.high / (2.5 * 3), 1, 0.01);
    EXPECT_EQ(cut.audit.lines[index_of(LoadKind::force)].over, 1u);
    // What is kept of a line does not grow with the cases.
    for (const auto& kept : {cut.audit.worst, cut.audit.tools, cut.lines})
        for (const LoadTally& tally : kept) EXPECT_TRUE(tally.cases.empty() && tally.bands);
}

// One tooth cuts the same chip whatever its run-out; two of them share it unevenly.
TEST(Verdict, has_no_band_of_runout_where_one_tooth_cuts) {
    for (const int flutes : {1, 2}) {
        MillSetup setup = slot_setup();
        setup.cutters[0].flutes = flutes;
        setup.cutters[0].runout_mm = 0.02;
        setup.cutters[0].runout_spread = 1;
        const AuditedCut cut = audited(std::move(setup), {.force_n = 10}, {}, 200);
        const RatioBand& ratio = *cut.verdict.findings[0].ratio;
        if (flutes == 1) {
            EXPECT_NEAR(ratio.high / ratio.low, 1, 1e-3);
        } else {
            EXPECT_GT(ratio.high / ratio.low, 1.1);
        }
    }
}

}  // namespace
}  // namespace tribo::session
