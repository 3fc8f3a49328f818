// SPDX-License-Identifier: MIT
#include "session/cut/mill_warnings.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "session/block_setup.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::session {
namespace {

// A slot across a block, at a feed per tooth.
MillSetup slot(double feed_per_tooth_mm) {
    const milling::Cutter cutter{.diameter_mm = 6};
    MillSetup s = block_setup({{0, 0, -5}, {20, 20, 0}}, cutter, MillSetup{}.cell_mm);
    motion::Move cut = straight_cut({-5, 10, -1}, {25, 10, -1}, feed_per_tooth_mm * cutter.flutes * 6000);
    cut.line = 7;
    add_cut(s, cut);
    return s;
}

MillTotals slotted(double feed_per_tooth_mm) {
    MillSession session(slot(feed_per_tooth_mm), serial_for);
    session.run({});
    return session.totals();
}

// The rows of the slot that a page gets, at a feed override.
std::vector<protocol::LiveRow> page_rows(double feed_per_tooth_mm, double feed_factor) {
    const auto live = LiveMill::create([=] { return slot(feed_per_tooth_mm); }, serial_for);
    EXPECT_TRUE(live);
    CutChange change;
    change.feed_factor = feed_factor;
    (*live)->set_change(change);
    (*live)->set_clock((*live)->duration_s());
    std::vector<protocol::LiveRow> rows;
    const auto keep = [&](std::span<const std::uint8_t> frame) {
        protocol::LiveRows told;
        if (protocol::read_frame(frame, told)) rows.insert(rows.end(), told.rows.begin(), told.rows.end());
    };
    (*live)->tick(0, [] { return true; }, keep);
    return rows;
}

TEST(MillWarnings, a_cut_as_books_advise_has_none) {
    EXPECT_TRUE(warnings_of(slotted(0.05), "a.toml", "a.nc").empty());
}

// A cutter wider than the block, along it: below its floor nothing is left, above it a plate is.
TEST(MillWarnings, a_stock_that_is_milled_away_is_told) {
    const auto milled = [](double tip_z_mm) {
        const milling::Cutter cutter{.diameter_mm = 32, .flutes = 4, .length_mm = 20};
        MillSetup s = block_setup({{0, 0, -5}, {20, 20, 0}}, cutter, MillSetup{}.cell_mm);
        add_cut(s, straight_cut({-20, 10, tip_z_mm}, {40, 10, tip_z_mm}, 1200));
        MillSession session(std::move(s), serial_for);
        session.run({});
        return session.totals();
    };
    const auto is_told = [](const MillTotals& totals) {
        return std::ranges::any_of(warnings_of(totals, "a.toml", "a.nc"), [](const Warning& warning) {
            return warning.text.starts_with("nothing is left of the stock");
        });
    };
    EXPECT_TRUE(is_told(milled(-6)));
    EXPECT_TRUE(is_told(milled(-5)));
    EXPECT_FALSE(is_told(milled(-4.99)));
}

TEST(MillWarnings, teeth_that_rub_are_told_with_the_programs_line) {
    const Warnings warnings = warnings_of(slotted(0.004), "a.toml", "a.nc");
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].file, "a.nc");
    EXPECT_EQ(warnings[0].line, 7);
    EXPECT_NE(warnings[0].text.find("rub rather than cut in 100 % of the cutting time"), std::string::npos)
        << warnings[0].text;
}

// S600 for S6000.
TEST(MillWarnings, a_tooth_that_takes_too_much_is_told_with_how_much) {
    const Warnings warnings = warnings_of(slotted(0.6), "a.toml", "a.nc");
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].line, 7);
    EXPECT_NE(warnings[0].text.find("a chip of 0.6 mm, 4 times 2.5 %"), std::string::npos)
        << warnings[0].text;
}

// Edges of 4 mm cut a tunnel 4 mm below the top; pulled up, the tool's back removes what lies above it.
TEST(MillWarnings, metal_that_no_edge_cuts_is_told_with_its_line) {
    const milling::Cutter cutter{.diameter_mm = 6, .length_mm = 4};
    MillSetup s = block_setup({{0, 0, -10}, {20, 20, 0}}, cutter, 0.1);
    const double feed = 0.05 * cutter.flutes * 6000;
    motion::Move tunnel = straight_cut({-5, 10, -8}, {10, 10, -8}, feed);
    motion::Move up = straight_cut({10, 10, -8}, {10, 10, -5}, feed);
    tunnel.line = 3;
    up.line = 4;
    add_cut(s, tunnel);
    add_cut(s, up);
    MillSession session(std::move(s), serial_for);
    session.run({});
    EXPECT_NEAR(session.totals().edgeless_mm3, math::kTwoPi / 2 * 9 * 3, 1);
    EXPECT_EQ(session.totals().edgeless_line, 4);
    const Warnings warnings = warnings_of(session.totals(), "a.toml", "a.nc");
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].line, 4);
    EXPECT_NE(warnings[0].text.find("no edge cuts 85 mm3 of it"), std::string::npos) << warnings[0].text;
}

// The limits are 0.01 mm and, of this cutter, 0.15 mm. 0.01 is less than itself in a frame's precision.
TEST(MillWarnings, a_chip_near_a_limit_is_told_alike_in_the_warning_and_on_the_page) {
    for (const double feed_mm : {0.0099999, 0.01, 0.0100001, 0.1499999, 0.15, 0.1500001}) {
        SCOPED_TRACE(feed_mm);
        const MillTotals totals = slotted(feed_mm);
        std::string warned;
        for (const Warning& w : warnings_of(totals, "a.toml", "a.nc")) warned += w.text + "\n";
        for (const double feed_factor : {1.0, 0.5}) {
            SCOPED_TRACE(feed_factor);
            double rubbing_s = 0, cutting_s = 0, thickest_mm = 0;
            std::size_t overloads = 0;
            for (const protocol::LiveRow& row : page_rows(feed_mm / feed_factor, feed_factor)) {
                cutting_s += row.end_s - row.t_s;
                const auto verdict = static_cast<milling::ChipVerdict>(row.chip_verdict);
                if (verdict == milling::ChipVerdict::rubs) rubbing_s += row.end_s - row.t_s;
                if (verdict == milling::ChipVerdict::overloads) ++overloads;
                thickest_mm = std::max(thickest_mm, row.chip_mm);
            }
            EXPECT_NEAR(rubbing_s / feed_factor, totals.chips.rubbing_s, 1e-6 * totals.duration_s);
            EXPECT_EQ(rubbing_s > 0.1 * cutting_s, warned.find("rub rather") != std::string::npos) << warned;
            EXPECT_EQ(overloads > 0, warned.find("a tooth takes a chip") != std::string::npos) << warned;
            EXPECT_NEAR(thickest_mm, feed_mm, 1e-6 * feed_mm);
        }
    }
}

TEST(MillWarnings, a_tool_that_meets_nothing_is_told) {
    const Warnings warnings = warnings_of({}, "a.toml", "a.nc");
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].text.find("nothing was cut"), std::string::npos);
}

}  // namespace
}  // namespace tribo::session
