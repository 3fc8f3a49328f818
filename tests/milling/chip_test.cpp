// SPDX-License-Identifier: MIT
// The thickest chip against closed forms and against a search along the turn; what is gathered of a program.
#include "milling/engagement/chip.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "milling/tool/cutter_profile.hpp"

namespace tribo::milling {
namespace {

Cutter cutter_of(CutterKind kind, double diameter_mm) {
    Cutter c;
    c.kind = kind;
    c.diameter_mm = diameter_mm;
    c.length_mm = 30;
    return c;
}

TEST(Chip, of_a_slot_is_the_feed_per_tooth) {
    const Engagement slot{{{0, 2, 0, math::kPi}}, {}};
    EXPECT_NEAR(thickest_chip_mm(slot, {0.1, 0}, cutter_of(CutterKind::flat, 10)), 0.1, 1e-15);
}

// Martellotti 1941: at a radial depth a_e below the radius the chip ends at sin phi = 2 sqrt(q - q^2), q =
// a_e / D.
TEST(Chip, of_a_side_cut_is_thinned_by_the_radial_depth) {
    for (const double q : {0.01, 0.1, 0.3, 0.5}) {
        const Engagement side{{{0, 5, 0, math::acos(1 - 2 * q)}}, {}};
        EXPECT_NEAR(thickest_chip_mm(side, {0.2, 0}, cutter_of(CutterKind::flat, 8)),
                    0.2 * 2 * std::sqrt(q - q * q), 1e-12)
            << q;
    }
}

// Of a ball at height z the normal leans by sin kappa = sqrt(1 - (1 - z / R)^2).
TEST(Chip, of_a_ball_is_thinned_by_the_lead_angle) {
    const double z = 0.5;
    const Engagement slot{{{z - 1e-6, z + 1e-6, 0, math::kPi}}, {}};
    EXPECT_NEAR(thickest_chip_mm(slot, {0.1, 0}, cutter_of(CutterKind::ball, 10)),
                0.1 * std::sqrt(1 - 0.9 * 0.9), 1e-9);
}

TEST(Chip, of_a_plunge_is_the_way_down_per_tooth) {
    const Engagement plunge{{}, {{0, 4, 0, math::kTwoPi}}};
    EXPECT_NEAR(thickest_chip_mm(plunge, {0, 0.03}, cutter_of(CutterKind::flat, 8)), 0.03, 1e-15);
    EXPECT_EQ(thickest_chip_mm(plunge, {0.1, 0}, cutter_of(CutterKind::flat, 8)), 0);
}

RC_GTEST_PROP(Chip, is_the_largest_travel_along_the_normal,
              (unsigned a, unsigned b, unsigned c, unsigned d, bool ball)) {
    const auto in = [](unsigned n, double low, double high) {
        return low + (high - low) * (n % 1009) / 1009.0;
    };
    const ToolTravel feed{in(a, 0, 0.3), in(b, -0.1, 0.1), in(c, -0.002, 0.002), in(d, -0.002, 0.002)};
    const double entry = in(a + 7 * b, 0, 6), exit = entry + in(c + 5 * d, 0.001, math::kTwoPi - entry);
    const double z = in(b + 3 * c, 0.01, 8);
    const Cutter cutter = cutter_of(ball ? CutterKind::ball : CutterKind::flat, 6);
    const CutterProfile profile(cutter);
    const TurnLaw law = normal_travel(feed, profile.at(profile.at_height(z)));
    double found = 0;
    for (int n = 0; n <= 20000; ++n) {
        const double phi = entry + (exit - entry) * n / 20000;
        found = std::max(found, law.sine * math::sin(phi) + law.cosine * math::cos(phi) + law.constant);
    }
    const double chip = thickest_chip_mm({{{z, z, entry, exit}}, {}}, feed, cutter);
    RC_ASSERT(chip >= found - 1e-15);
    RC_ASSERT(chip <= found + 1e-7);
}

CutRow row_of(int line, double feed_mm, double seconds) {
    CutRow row;
    row.line = line;
    row.end_s = seconds;
    row.feed = {feed_mm, 0};
    row.engagement.bands = {{0, 1, 0, math::kPi}};
    return row;
}

TEST(ChipFindings, name_the_longest_rubbing_and_the_worst_overload) {
    const Cutter cutter = cutter_of(CutterKind::flat, 10);
    ChipFindings findings;
    const auto add = [&](int line, double feed_mm, double seconds) {
        const CutRow row = row_of(line, feed_mm, seconds);
        findings.add(row, thickest_chip_mm(row.engagement, row.feed, cutter), cutter);
    };
    add(1, 0.1, 1);
    add(2, 0.005, 1);
    add(3, 0.004, 2);
    add(3, 0.004, 2);
    add(3, 0.1, 1);
    add(3, 0.004, 3);
    add(4, 0.3, 1);
    add(4, 0.5, 1);
    add(5, 0.26, 1);
    EXPECT_DOUBLE_EQ(findings.rubbing_s, 8);
    EXPECT_EQ(findings.rubbing_line, 3);
    EXPECT_DOUBLE_EQ(findings.overload, 2);
    EXPECT_DOUBLE_EQ(findings.overload_mm, 0.5);
    EXPECT_EQ(findings.overload_line, 4);
    EXPECT_EQ(findings.overloaded_lines, 2u);
}

TEST(ChipVerdict, turns_at_its_limits) {
    const Cutter cutter = cutter_of(CutterKind::flat, 4);
    EXPECT_EQ(chip_verdict(0.0099, cutter), ChipVerdict::rubs);
    EXPECT_EQ(chip_verdict(0.0101, cutter), ChipVerdict::cuts);
    EXPECT_EQ(chip_verdict(0.0999, cutter), ChipVerdict::cuts);
    EXPECT_EQ(chip_verdict(0.1001, cutter), ChipVerdict::overloads);
}

}  // namespace
}  // namespace tribo::milling
