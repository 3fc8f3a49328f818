// SPDX-License-Identifier: MIT
#include "session/cut/mill_warnings.hpp"

#include <gtest/gtest.h>

#include "base/math.hpp"
#include "field/shape/box_shape.hpp"
#include "milling/tool/materials.hpp"

namespace tribo::session {
namespace {

// A slot across a block, at a feed per tooth.
MillTotals slotted(double feed_per_tooth_mm) {
    MillSetup setup;
    setup.cutters.emplace_back().diameter_mm = 6;
    setup.coefficients = milling::find_material("al7075-t6")->coefficients;
    setup.blank = std::make_unique<field::BoxShape>(Box3{{0, 0, -5}, {20, 20, 0}});
    setup.blank_volume_mm3 = 2000;
    motion::Move slot;
    slot.start.tip_mm = {-5, 10, -1};
    slot.end.tip_mm = {25, 10, -1};
    slot.feed_mm_per_min = feed_per_tooth_mm * setup.cutters[0].flutes * 6000;
    slot.line = 7;
    setup.moves = {slot};
    setup.cutter_of_move = {0};
    setup.rpm_of_move = {6000};
    MillSession session(std::move(setup), serial_for);
    session.run({});
    return session.totals();
}

TEST(MillWarnings, a_cut_as_books_advise_has_none) {
    EXPECT_TRUE(warnings_of(slotted(0.05), "a.toml", "a.nc").empty());
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

TEST(MillWarnings, a_tool_that_meets_nothing_is_told) {
    const Warnings warnings = warnings_of({}, "a.toml", "a.nc");
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].text.find("nothing was cut"), std::string::npos);
}

}  // namespace
}  // namespace tribo::session
