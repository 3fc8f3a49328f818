// SPDX-License-Identifier: MIT
#include "readers/tables/tool_table.hpp"

#include <gtest/gtest.h>

namespace tribo::readers {
namespace {

std::string fault(std::string_view text) {
    const auto table = read_tool_table(text, {.source_name = "t.tbl"});
    return table ? "" : table.error().text();
}

TEST(ToolTable, ReadsLinuxCncWordsInAnyOrder) {
    const auto table = read_tool_table(
        "; tools of the day\r\nT1 P1 X0 Y0 Z+50.25 D6.0 I0 J0 Q0 ;6 mm, 2 flutes\r\n\r\nD12.5 T20 P3\n"
        "T0 P0 Z0\n",
        {.source_name = "tool.tbl"});
    ASSERT_TRUE(table) << table.error().text();
    ASSERT_EQ(table->tools.size(), 2u);
    EXPECT_EQ(table->tools[0].number, 1);
    EXPECT_EQ(table->tools[0].diameter_mm, 6);
    EXPECT_EQ(table->tools[0].length_mm, 50.25);
    EXPECT_EQ(table->tools[0].line, 2);
    EXPECT_EQ(table->tools[0].table, "tool.tbl");
    EXPECT_EQ(table->tools[1].diameter_mm, 12.5);
    EXPECT_FALSE(table->tools[1].length_mm);
    const auto inches = read_tool_table("T1 P1 D0.5 Z2\n", {.unit = LengthUnit::inch});
    EXPECT_NEAR(inches->tools[0].diameter_mm, 12.7, 1e-12);
    EXPECT_NEAR(inches->tools[0].length_mm.value(), 50.8, 1e-12);
}

TEST(ToolTable, ReadsCsvByItsHeader) {
    const auto table = read_tool_table(
        "\xEF\xBB\xBFnumber, Diameter_mm, corner_mm, name, flutes, length_mm\n3, 10, 5, ball, 2, "
        "80\n4,16,,roughing,4,\n");
    ASSERT_TRUE(table) << table.error().text();
    ASSERT_EQ(table->tools.size(), 2u);
    EXPECT_EQ(table->tools[0].corner_mm, 5);
    EXPECT_EQ(table->tools[0].flutes, 2);
    EXPECT_EQ(table->tools[0].length_mm, 80);
    EXPECT_EQ(table->tools[1].flutes, 4);
    EXPECT_FALSE(table->tools[1].length_mm);
    ASSERT_EQ(table->warnings.size(), 1u);
    EXPECT_NE(table->warnings[0].text.find("'name' is not read"), std::string::npos);
}

TEST(ToolTable, RefusesWithPlaceCauseAndRemedy) {
    EXPECT_EQ(
        fault(""),
        "t.tbl: error: the tool table holds no tool; write a line as T1 P1 D6 Z50 for each, or a CSV table "
        "with number and diameter_mm");
    EXPECT_EQ(fault("T1 D6\nT1 D8\n"),
              "t.tbl:2:1: error: tool 1 stands in the table twice; delete one of the lines");
    EXPECT_EQ(fault("T1.5 D6\n"), "t.tbl:1:1: error: tool number: 1.5 is not a whole number; correct it");
    EXPECT_EQ(fault("T1 D-6\n"),
              "t.tbl:1:4: error: the cutter diameter of -6 mm is out of range; keep the cutter diameter "
              "within 0.01 to 1000 mm");
    EXPECT_NE(fault("hello world\n").find("t.tbl:1:1: error: a tool's line is words"), std::string::npos);
    EXPECT_NE(fault("number,flutes\n1,2\n").find("has no column 'diameter_mm'"), std::string::npos);
    EXPECT_EQ(fault("number,diameter_mm\n1,six\n"), "t.tbl:2:3: error: 'six' is no number; correct it");
    EXPECT_NE(fault("number,diameter_mm,corner_mm\n1,6,4\n").find("more than half"), std::string::npos);
    EXPECT_NE(fault("number,diameter_mm,flutes\n1,6,2.5\n").find("flutes: 2.5 is not a whole number"),
              std::string::npos);
}

// Tables of machine makers have a few hundred tools; comparing each with all others would take hours here.
TEST(ToolTable, ReadsAsManyToolsAsHaveNumbers) {
    std::string text;
    for (int number = 1; number <= 300'000; ++number) text += "T" + std::to_string(number) + " D6\n";
    const auto table = read_tool_table(text);
    ASSERT_TRUE(table) << table.error().text();
    EXPECT_EQ(table->tools.size(), 300'000u);
    EXPECT_EQ(fault(text + "T7 D8\n"),
              "t.tbl:300001:1: error: tool 7 stands in the table twice; delete one of the lines");
}

TEST(ToolTable, TakesNoMemoryForALineOfCommas) {
    const auto table = read_tool_table("number,diameter_mm" + std::string(3'000'000, ',') + "\n1,6\n");
    ASSERT_TRUE(table) << table.error().text();
    EXPECT_LT(table->warnings.size(), 1000u);
}

}  // namespace
}  // namespace tribo::readers
