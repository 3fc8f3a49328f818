// SPDX-License-Identifier: MIT
#include "readers/rewrite/speed_words.hpp"

#include <gtest/gtest.h>

namespace tribo::readers {
namespace {

std::string with_speeds(std::string_view text, FeedLanguage language, std::vector<LineSpeed> speeds) {
    auto written = with_speeds(text, language, speeds, "p.nc");
    EXPECT_TRUE(written) << written.error().text();
    return written ? *std::move(written) : std::string();
}

TEST(SpeedWords, follow_the_moves_for_which_they_hold) {
    EXPECT_EQ(with_speeds("G21\nS6000 M3\nT1 M6\nG1 X1 F9\nT2 M6 S8000\nX2\n(S1)\nM30\n", FeedLanguage::gcode,
                          {{4, 1.5}, {6, 1}}),
              "G21\nS9000 M3\nT1 M6\nG1 X1 F9\nT2 M6 S8000\nX2\n(S1)\nM30\n");
}

TEST(SpeedWords, keep_the_decimals_and_the_line_ends) {
    EXPECT_EQ(with_speeds("M3S6000.\r\nG1X1F9\r\n", FeedLanguage::gcode, {{2, 1.1}}),
              "M3S6600.\r\nG1X1F9\r\n");
    EXPECT_EQ(with_speeds("S1234.50\nG1 X1\n", FeedLanguage::gcode, {{2, 0.5}}), "S617.25\nG1 X1\n");
    EXPECT_EQ(with_speeds("S1000\nG1 X1\n", FeedLanguage::gcode, {{2, 0.33333}}), "S333\nG1 X1\n");
}

TEST(SpeedWords, of_all_languages_are_found) {
    EXPECT_EQ(with_speeds("S=6000 M3\nG1 X1 F5\n", FeedLanguage::siemens, {{2, 0.5}}),
              "S=3000 M3\nG1 X1 F5\n");
    EXPECT_EQ(with_speeds("1 TOOL CALL 5 Z S6000 F200\n2 L X+1\n", FeedLanguage::heidenhain, {{2, 0.5}}),
              "1 TOOL CALL 5 Z S3000 F200\n2 L X+1\n");
    EXPECT_EQ(with_speeds("SPINDL/RPM,6000,CLW\nGOTO/1,2,3\nSPINDL/OFF\nGOTO/2,2,3\n", FeedLanguage::apt,
                          {{2, 0.5}, {4, 0.5}}),
              "SPINDL/RPM,3000,CLW\nGOTO/1,2,3\nSPINDL/OFF\nGOTO/2,2,3\n");
}

TEST(SpeedWords, that_are_computed_are_refused_where_they_should_change) {
    const std::vector<LineSpeed> speeds{{2, 0.5}};
    const auto refused = with_speeds("S#1 M3\nG1 X1\n", FeedLanguage::gcode, speeds, "p.nc");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().line, 1);
    const std::vector<LineSpeed> same{{2, 1}};
    EXPECT_TRUE(with_speeds("S#1 M3\nG1 X1\n", FeedLanguage::gcode, same, "p.nc"));
}

}  // namespace
}  // namespace tribo::readers
