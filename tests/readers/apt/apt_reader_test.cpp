// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <string>
#include <vector>

#include "motion/program_summary.hpp"
#include "readers/apt/apt_text.hpp"
#include "readers/real_files.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

using motion::Move;
using motion::MoveKind;
using motion::Program;

TEST(AptReader, ReadsAFiveAxisProgram) {
    const Program program =
        apt("PARTNO  wheel, $ and more\n"
            "$$ a comment\n"
            "MACHIN/PWORKS,0\n"
            "UNITS/MM\n"
            "MULTAX/ON\n"
            "LOADTL/4,LENGTH,80\n"
            "CUTTER/16,2,6,2,0,0,40\n"
            "SPINDL/RPM,9000,CLW\n"
            "COOLNT/ON\n"
            "RAPID\n"
            "GOTO/0,0,50,0,0,1\n"
            "RAPID\n"
            "GOTO/0,0,10\n"
            "FEDRAT/250,MMPM\n"
            "GOTO  /   0.0, 0.0, .5, 0., 0.6, 0.8\n"
            "goto/ 10., $ the rest follows\n"
            "      0, -1.5E-1\n"
            "GOTO/10,0,-.15,0,.6,.8\n"
            "DELAY/2\n"
            "SPINDL/OFF\n"
            "FINI\n");
    ASSERT_EQ(program.moves.size(), 4U);
    const Move& approach = program.moves[0];
    EXPECT_EQ(approach.kind, MoveKind::rapid);
    EXPECT_EQ(approach.line, 13);
    EXPECT_EQ(approach.start.tip_mm, (Vec3{0, 0, 50}));
    EXPECT_EQ(approach.end.axis, (Vec3{0, 0, 1}));
    const Move& plunge = program.moves[1];
    EXPECT_EQ(plunge.kind, MoveKind::feed);
    EXPECT_EQ(plunge.feed_mm_per_min, 250);
    EXPECT_EQ(plunge.spindle_rpm, 9000);
    EXPECT_EQ(plunge.tool, 4);
    EXPECT_NEAR(distance(plunge.end.axis, {0, 0.6, 0.8}), 0, 1e-15);
    const Move& cut = program.moves[2];
    EXPECT_EQ(cut.line, 16);
    EXPECT_EQ(cut.end.tip_mm, (Vec3{10, 0, -0.15}));
    EXPECT_EQ(cut.end.axis, plunge.end.axis);
    EXPECT_EQ(program.moves[3].kind, MoveKind::dwell);
    EXPECT_EQ(program.moves[3].duration_s, 2);
    ASSERT_EQ(program.tools.size(), 1U);
    EXPECT_EQ(program.tools[0].number, 4);
    EXPECT_EQ(program.tools[0].diameter_mm, 16);
    EXPECT_EQ(program.tools[0].corner_mm, 2);
    EXPECT_EQ(program.tools[0].line, 7);
    EXPECT_FALSE(program.has_rotary_words);
    EXPECT_TRUE(program.warnings.empty());
}

TEST(AptReader, ConvertsFeedsByTheirUnit) {
    struct Case {
        const char* statement;
        double feed_mm_per_min;
    };
    const Case cases[] = {
        {"FEDRAT/10", 254},       {"FEDRAT/10,IPM", 254},      {"FEDRAT/IPM,10", 254},
        {"FEDRAT/300,MMPM", 300}, {"FEDRAT/10,PERMIN", 254},   {"FEDRAT/0.01,IPR", 254},
        {"FEDRAT/0.2,MMPR", 200}, {"FEDRAT/0.01,PERREV", 254},
    };
    for (const Case& c : cases) {
        const Program program =
            apt(std::string("UNITS/INCHES\nSPINDL/1000\n") + c.statement + "\nGOTO/0,0,0\nGOTO/1,0,0\n");
        ASSERT_EQ(program.moves.size(), 1U);
        EXPECT_NEAR(program.moves[0].feed_mm_per_min, c.feed_mm_per_min, 1e-9) << c.statement;
        EXPECT_NEAR(program.moves[0].end.tip_mm.x, 25.4, 1e-12);
    }
}

TEST(AptReader, TakesMillimetresWithAWarningWhereNoUnitIsStated) {
    const char* const text = "CUTTER/2\nFEDRAT/10\nGOTO/0,0,0\nGOTO/1,0,0\n";
    const Program metric = apt(text);
    EXPECT_TRUE(warns_of(metric, 3, "millimetres"));
    EXPECT_EQ(metric.moves[0].end.tip_mm.x, 1);
    AptOptions inches;
    inches.default_unit = LengthUnit::inch;
    const Program imperial = apt(text, inches);
    EXPECT_TRUE(warns_of(imperial, 3, "inches"));
    EXPECT_EQ(imperial.moves[0].end.tip_mm.x, 25.4);
    EXPECT_EQ(imperial.tools[0].diameter_mm, 50.8);
}

TEST(AptReader, KeepsTheAxisUntilMultaxOff) {
    const Program program = apt(
        "UNITS/MM\nFEDRAT/10\nMULTAX\nFROM/0,0,0,1,0,0\nGOTO/1,0,0\nMULTAX/OFF\nGOTO/2,0,0\nGOTO/2,0,0\n");
    ASSERT_EQ(program.moves.size(), 2U);
    EXPECT_EQ(program.moves[0].start.axis, (Vec3{1, 0, 0}));
    EXPECT_EQ(program.moves[0].end.axis, (Vec3{1, 0, 0}));
    EXPECT_EQ(program.moves[1].end.axis, (Vec3{0, 0, 1}));
}

TEST(AptReader, DeclaresEachCutterOnceForTheToolThatHoldsIt) {
    const Program program =
        apt("UNITS/MM\nFEDRAT/10\nCUTTER/6\nLOADTL/1\nGOTO/0,0,0\nCUTTER/6\nGOTO/1,0,0\n"
            "CUTTER/10,5\nLOAD/TOOL,2,ADJUST,1\nGOTO/2,0,0\n");
    ASSERT_EQ(program.tools.size(), 2U);
    EXPECT_EQ(program.tools[0].number, 1);
    EXPECT_EQ(program.tools[1].number, 2);
    EXPECT_EQ(program.tools[1].corner_mm, 5);
    EXPECT_EQ(program.moves[0].tool, 1);
    EXPECT_EQ(program.moves[1].tool, 2);
    EXPECT_TRUE(warns_of(apt("UNITS/MM\nCUTTER/22,.1,0,.1,0,-89,.2\nGOTO/0,0,0\n"), 2, "cone"));
}

TEST(AptReader, WarnsOfASpindleThatDoesNotCut) {
    const Program program = apt(
        "UNITS/MM\nFEDRAT/10\nSPINDL/100,CCLW\nSPINDL/OFF\nGOTO/0,0,0\nGOTO/1,0,0\nGOTO/2,0,0\nFINI\nGOTO/"
        "3,0,0\n");
    EXPECT_TRUE(warns_of(program, 3, "backwards"));
    EXPECT_TRUE(warns_of(program, 6, "spindle off"));
    EXPECT_TRUE(warns_of(program, 8, "FINI"));
    EXPECT_EQ(program.warnings.size(), 3U);
    EXPECT_EQ(program.moves.size(), 2U);
}

TEST(AptReader, RefusesWhatItDoesNotKnowWithItsPlace) {
    const std::string ready = "UNITS/MM\nGOTO/0,0,0\n";  // two lines
    const Refusal refusals[] = {
        {"", 0, 0, "no APT statement"},
        {"$$ only a comment\n\n", 0, 0, "no APT statement"},
        {"G0 X1 Y2\n", 1, 1, "'G0 X1 Y2' is not known"},
        {"FOO/1\n", 1, 1, "'FOO' is not known"},
        {"  /1\n", 1, 3, "no word before the slash"},
        {"GOTO/1,2 $\n", 1, 1, "where the file ends"},
        {"GOTO/1,2 $\n3\n", 2, 1, "comma is missing"},
        {"GOTO $\n/1,2,3\n", 1, 6, "before its slash"},
        {"GOTO/1,2\n", 1, 1, "has 2 numbers"},
        {"GOTO/1,2,\n", 1, 9, "a number is missing"},
        {"GOTO/1,2, $$ this ends the line\n3\n", 1, 10, "a number is missing"},
        {"GOTO/1,,2\n", 1, 8, "a number is missing"},
        {"GOTO/1, two,3\n", 1, 9, "'two' is not a number"},
        {"GOTO/1,nan,3\n", 1, 8, "'nan' is not a number"},
        {"GOTO/1,1e999,3\n", 1, 8, "is not a number"},
        {"GOTO/1,1e99,3\n", 1, 8, "'1e99' is out of range"},
        {"GOTO/1,$\n 2,$\n  z\n", 3, 3, "'z' is not a number"},
        {"GOTO/1,\xE4,3\n", 1, 8, "'?' is not a number"},
        {"GOTO/0,0,0,0,0,0\n", 1, 12, "no length"},
        {ready + "GOTO/1,0,0\n", 3, 1, "before any FEDRAT"},
        {ready + "FEDRAT/.1,MMPR\nGOTO/1,0,0\n", 4, 1, "spindle speed unknown"},
        {"FEDRAT/\n", 1, 1, "without a number"},
        {"FEDRAT/0\n", 1, 8, "the feed of 0 mm/min is out of range"},
        {"FEDRAT/-5\n", 1, 8, "out of range"},
        {"FEDRAT/5,6\n", 1, 10, "second feed rate"},
        {"FEDRAT/5,FURLONGS\n", 1, 10, "'FURLONGS' is not a number"},
        {"SPINDL/100,FPS\n", 1, 12, "'FPS' is not a number"},
        {"UNITS/CUBITS\n", 1, 7, "neither MM nor INCHES"},
        {"UNITS\n", 1, 1, "neither MM nor INCHES"},
        {"LOADTL/1.5\n", 1, 8, "not a whole number"},
        {"LOADTL\n", 1, 1, "no tool number"},
        {"LOAD/WIRE,1\n", 1, 1, "not a tool"},
        {"CUTTER/0\n", 1, 8, "without a diameter"},
        {"CUTTER/6,4\n", 1, 10, "does not fit"},
        {"CUTTER/1,2,3,4,5,6,7,8\n", 1, 1, "CUTTER with 8 numbers"},
        {"MULTAX/MAYBE\n", 1, 8, "neither ON nor OFF"},
        {"RAPID/ALL\n", 1, 7, "conditions"},
        {"DELAY/2,3\n", 1, 1, "single number"},
    };
    expect_refused_apt(refusals);
    AptOptions few;
    few.max_moves = 1;
    EXPECT_FALSE(read_apt("FEDRAT/1\nGOTO/0,0,0\nGOTO/1,0,0\nGOTO/2,0,0\n", few).has_value());
}

RC_GTEST_PROP(AptReader, BlanksCommentsAndContinuationsChangeNothing, ()) {
    std::string plain = "UNITS/MM\nMULTAX/ON\nFEDRAT/100\n",
                dressed = "units / mm\nMULTAX\nFEDRAT/ 100 ,PERMIN\n";
    const int points = *rc::gen::inRange(2, 30);
    for (int i = 0; i < points; ++i) {
        plain += "GOTO/";
        dressed += *rc::gen::element<std::string>("GOTO/", " goto  / ", "$$ note\n\nGOTO/  $ more\n ");
        for (int k = 0; k < 6; ++k) {
            const std::string number =
                short_decimal(*rc::gen::inRange(-90'000, 90'000) / 1000.0, 3) + (k == 5 ? "1" : "");
            plain += (k > 0 ? "," : "") + number;
            if (k > 0) dressed += *rc::gen::element<std::string>(",", " , ", ",$\n", "$ x\n,");
            dressed += number;
        }
        plain += "\n";
        dressed += *rc::gen::element<std::string>("\n", "\r\n", "  \n", " $$ end\n");
    }
    const auto a = read_apt(plain), b = read_apt(dressed);
    RC_ASSERT(a.has_value() == b.has_value());
    if (!a) return;
    RC_ASSERT(a->moves.size() == b->moves.size());
    for (std::size_t i = 0; i < a->moves.size(); ++i) {
        RC_ASSERT(a->moves[i].end == b->moves[i].end);
        RC_ASSERT(std::abs(length(a->moves[i].end.axis) - 1) < 1e-12);
    }
}

// Count, length and box were computed by an independent script from the words of the file.
TEST(AptReader, ReadsARealProgramToTheLengthOfAnIndependentScript) {
    const auto bytes = real_file("ncl-5x-pmill.cldata");
    if (!bytes) GTEST_SKIP() << "no ../shared/data/gcode";
    AptOptions options;
    options.default_unit = LengthUnit::inch;
    options.default_feed_mm_per_min = 1000;
    const Program program = apt(*bytes, options);
    const motion::ProgramSummary summary = motion::testing::summary_of(program);
    EXPECT_EQ(summary.moves, 3684U);
    EXPECT_NEAR(summary.path_mm, 4220.786663, 1e-6);
    EXPECT_NEAR(distance(summary.bounds_mm.min, {-209.02168, -114.55146, -103.93172}), 0, 1e-9);
    EXPECT_NEAR(distance(summary.bounds_mm.max, {-88.14054, 15.48892, -41.24198}), 0, 1e-9);
    EXPECT_TRUE(summary.tilted);
    EXPECT_FALSE(read_apt(*bytes).has_value());  // it states no feed
}

// Likewise, by a script of its own: rapids end with the next FEDRAT or GOTO, each hole of the two cycles is
// drilled to its depth (in pecks of 5 and 2 mm, back to 0.254 mm) and left to its RTRCTO.
TEST(AptReader, ReadsARealProgramWithFramesAndCycles) {
    const auto bytes = real_file("aptpost-3x-tilt-support.apt");
    if (!bytes) GTEST_SKIP() << "no ../shared/data/gcode";
    const Program program = apt(*bytes);
    const motion::ProgramSummary summary = motion::testing::summary_of(program);
    EXPECT_EQ(summary.tools, (std::vector<int>{4, 6, 16}));
    EXPECT_EQ(program.tools.size(), 3U);
    EXPECT_TRUE(summary.tilted);
    EXPECT_NEAR(summary.path_mm, 2446.240468906, 1e-6);
    EXPECT_NEAR(distance(summary.bounds_mm.min, {4.253899, -8.8, -16.102901687510304}), 0, 1e-6);
    EXPECT_NEAR(distance(summary.bounds_mm.max, {38.868241, 48.8, 5.599297}), 0, 1e-6);
    const Move& hole = program.moves[program.moves.size() - 3];
    EXPECT_EQ(hole.kind, MoveKind::feed);
    EXPECT_EQ(hole.line, 345);
    EXPECT_NEAR(hole.feed_mm_per_min, 1097.28, 1e-9);
    EXPECT_NEAR(
        distance(hole.end.tip_mm, Vec3{15.756924, 30, -6.156343} + 10.1 * Vec3{0.173648, 0, -0.984808}), 0,
        1e-5);
}

}  // namespace
}  // namespace tribo::readers
