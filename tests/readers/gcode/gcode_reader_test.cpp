// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "readers/gcode/gcode_text.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::readers {
namespace {

using motion::Move;
using motion::MoveKind;
using motion::Program;

TEST(GcodeReader, GivesEachMoveItsKindEndsFeedSpindleToolAndLine) {
    const Program program = program_of(
        "G21 G90\n"
        "T3 M6\n"
        "M3 S8000\n"
        "G0 X1 Y2 Z10\n"
        "G0 Z1\n"
        "G1 Z-1 F120\n"
        "X11 F400\n");
    ASSERT_EQ(program.moves.size(), 3U);
    const Move& retreat = program.moves[0];
    EXPECT_EQ(retreat.kind, MoveKind::rapid);
    EXPECT_EQ(retreat.line, 5);
    expect_near(retreat.start.tip_mm, {1, 2, 10});
    expect_near(retreat.end.tip_mm, {1, 2, 1});
    const Move& plunge = program.moves[1];
    EXPECT_EQ(plunge.kind, MoveKind::feed);
    EXPECT_EQ(plunge.feed_mm_per_min, 120);
    const Move& cut = program.moves[2];
    EXPECT_EQ(cut.feed_mm_per_min, 400);
    EXPECT_EQ(cut.spindle_rpm, 8000);
    EXPECT_EQ(cut.tool, 3);
    EXPECT_EQ(cut.line, 7);
    EXPECT_EQ(cut.duration_s, 0);
    expect_near(cut.end.tip_mm, {11, 2, -1});
    expect_near(cut.end.axis, {0, 0, 1});
    EXPECT_TRUE(program.warnings.empty());
}

TEST(GcodeReader, ReadsEverySpellingOfABlock) {
    const Program plain = program_of("G21\nM3 S100\nG0 X0 Y0 Z0\nG1 X16.339 Z-10 F200\n");
    const char* const spellings[] = {
        "g21\nm3s100\ng0x0y0z0\ng1x16.339z-10f200\n",
        "G21\r\nM3 S100\r\nG0 X0 Y0 Z0\r\nG1 X16.339 Z-10 F200\r\n",
        "G21\rM3 S100\rG0 X0 Y0 Z0\rG1 X16.339 Z-10 F200",
        "\xEF\xBB\xBFG21\nM3 S100\nG0 X0 Y0 Z0\nG1 X16.339 Z-10 F200\n",
        "%\nO0012 (NAME)\nN10 G21\nN20 M3 S100\nN30 G0 X0 Y0 Z0\nN40 G1 X16.339 Z-10 F200\n%\n",
        "G21\nM3 S100\nG0 X0 Y0 Z0\nG01 X  16.339 Z -10.0 F+200.\n",
        "G21\nM3 S100\nG0 X0 Y0 Z0\nG1X1 6.3 39\tZ- 1 0F2 0 0\n",
        "G21 (Fr\xE4ser \xD8 6)\nM3 S100 ; Drehzahl \xB5\nG0 X0 (x) Y0 Z0\nG1 (cut) X16.339 Z-10 F200\n",
        "G21\nM3 S100\nX0 Y0 Z0 G0\nF200 Z-10 X16.339 G1\n",
        "G21 M3 S100\nG00 X0 Y0 Z0\n\n\n/G1 X99\nG1 X16.339 Z-10 F200 M30\n%\n",
    };
    for (const char* text : spellings) {
        const Program program = program_of(text);
        ASSERT_EQ(program.moves.size(), 1U) << text;
        EXPECT_EQ(program.moves[0].start, plain.moves[0].start) << text;
        EXPECT_EQ(program.moves[0].end, plain.moves[0].end) << text;
        EXPECT_EQ(program.moves[0].feed_mm_per_min, 200) << text;
        EXPECT_EQ(program.moves[0].spindle_rpm, 100) << text;
    }
}

TEST(GcodeReader, MakesNoMoveBeforeAllCoordinatesAreKnown) {
    const Program program = program_of("G21 G0 Z5\nX1\nY1\nX2\n");
    ASSERT_EQ(program.moves.size(), 1U);
    EXPECT_EQ(program.moves[0].line, 4);
    EXPECT_NEAR(rapid_mm(program), 1, 1e-12);
}

TEST(GcodeReader, MakesNoMoveWhereNothingMoves) {
    const Program program = program_of("G21 M3 F100\nG0 X0 Y0 Z0\nX0\nG1 Z0\nG1 X1\nX1\n");
    ASSERT_EQ(program.moves.size(), 1U);
    EXPECT_EQ(program.moves[0].line, 5);
}

TEST(GcodeReader, StartsAFeedMoveAtZeroWhereNothingElseIsStatedAndSaysSo) {
    const Program program = program_of("G21 M3\nG0 Z3\nG1 Z-1 F100\n");
    ASSERT_EQ(program.moves.size(), 1U);
    expect_near(program.moves[0].start.tip_mm, {0, 0, 3});
    EXPECT_TRUE(warns_of(program, 3, "X0, Y0"));
}

TEST(GcodeReader, TakesMillimetresWithAWarningWhereNoUnitIsStated) {
    const Program program = program_of("M3\nG0 X0 Y0 Z0\nG1 X1 F100\n");
    EXPECT_TRUE(warns_of(program, 2, "millimetres"));
    EXPECT_NEAR(feed_mm(program), 1, 1e-12);

    GcodeOptions inches;
    inches.default_unit = LengthUnit::inch;
    const Program in_inches = program_of("M3\nG0 X0 Y0 Z0\nG1 X1 F100\n", inches);
    EXPECT_TRUE(warns_of(in_inches, 2, "inches"));
    EXPECT_NEAR(feed_mm(in_inches), 25.4, 1e-12);
    EXPECT_NEAR(in_inches.moves[0].feed_mm_per_min, 2540, 1e-9);
}

TEST(GcodeReader, KeepsTheFeedWhenTheUnitChanges) {
    const Program program = program_of("G20 M3\nG0 X0 Y0 Z0\nG1 X1 F10\nG21 X30\n");
    ASSERT_EQ(program.moves.size(), 2U);
    EXPECT_NEAR(program.moves[1].feed_mm_per_min, 254, 1e-9);
    EXPECT_NEAR(program.moves[1].end.tip_mm.x, 30, 1e-12);
}

TEST(GcodeReader, AddsIncrements) {
    const Program program = program_of("G21 M3 F100\nG0 X1 Y1 Z1\nG91 G1 X2\nY3 Z-1\nG90 X0\n");
    ASSERT_EQ(program.moves.size(), 3U);
    expect_near(program.moves[1].end.tip_mm, {3, 4, 0});
    expect_near(program.moves[2].end.tip_mm, {0, 4, 0});
}

TEST(GcodeReader, TakesTimeFromInverseTimeFeed) {
    // F4 in G93: a quarter of a minute, whatever the length.
    const Program program = program_of("G21 M3\nG0 X0 Y0 Z0\nG93 G1 X30 F4\nG94 X0 F600\n");
    ASSERT_EQ(program.moves.size(), 2U);
    EXPECT_NEAR(program.moves[0].duration_s, 15, 1e-12);
    EXPECT_NEAR(program.moves[0].feed_mm_per_min, 120, 1e-9);
    EXPECT_EQ(program.moves[1].duration_s, 0);
    EXPECT_EQ(program.moves[1].feed_mm_per_min, 600);
}

TEST(GcodeReader, MultipliesFeedPerTurnBySpindleSpeed) {
    const Program program = program_of("G21 M3 S3000\nG0 X0 Y0 Z0\nG95 G1 X30 F0.1\nS2000 X0\n");
    ASSERT_EQ(program.moves.size(), 2U);
    EXPECT_NEAR(program.moves[0].feed_mm_per_min, 300, 1e-9);
    EXPECT_NEAR(program.moves[1].feed_mm_per_min, 200, 1e-9);
}

TEST(GcodeReader, DwellsInSeconds) {
    const Program program = program_of("G21\nG4 P9\nG0 X0 Y0 Z0\nG4 P1.5\n");
    ASSERT_EQ(program.moves.size(), 1U);
    EXPECT_EQ(program.moves[0].kind, MoveKind::dwell);
    EXPECT_EQ(program.moves[0].duration_s, 1.5);
    EXPECT_EQ(program.moves[0].line, 4);
}

TEST(GcodeReader, DwellsInMillisecondsOnFanucControlsWithoutADecimalPoint) {
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    const auto seconds = [&](const std::string& text) {
        double sum = 0;
        for (const motion::Move& move : program_of("G21 M3 S900 F90\nG0 X0 Y0 Z5\n" + text, options).moves)
            sum += move.kind == MoveKind::dwell ? move.duration_s : 0;
        return sum;
    };
    EXPECT_EQ(seconds("G4 P1500\n"), 1.5);
    EXPECT_EQ(seconds("G4 P2.\n"), 2);
    EXPECT_EQ(seconds("G4 P0.25\n"), 0.25);
    EXPECT_EQ(seconds("#1=2.5\nG4 P[#1*1000.]\n"), 2.5);
    // X and U count the same increments; a variable holds seconds, as one of a coordinate holds millimetres.
    EXPECT_EQ(seconds("G4 X0.5\n"), 0.5);
    EXPECT_EQ(seconds("G4 X2000\n"), 2);
    EXPECT_EQ(seconds("G4 U250\n"), 0.25);
    EXPECT_EQ(seconds("#1=2\nG4 X#1\n"), 2);
    EXPECT_TRUE(warns_of(program_of("G21\nG0 X0 Y0 Z5\nG4 X2000\n", options), 3, "counts milliseconds"));
    EXPECT_EQ(program_of("G21\nG0 X0 Y0 Z5\nG4 X2\n").moves.back().duration_s, 2);  // LinuxCNC
    EXPECT_EQ(seconds("G82 Z-1 R1 P500\nX3\nG80\n"), 1);
    EXPECT_EQ(seconds("G82 Z-1 R1 P.5\nX3\nG80\n"), 1);
}

// LinuxCNC, G-code overview, polar coordinates.
TEST(GcodeReader, GoesToPolarPoints) {
    const auto ends = [](const std::string& text) {
        std::vector<Vec3> all;
        for (const motion::Move& move : program_of("G21 M3 F100\nG0 X0 Y0 Z5\n" + text).moves)
            all.push_back(move.end.tip_mm);
        return all;
    };
    const auto expect_ends = [&](const std::string& text, const std::vector<Vec3>& expected) {
        const std::vector<Vec3> found = ends(text);
        ASSERT_EQ(found.size(), expected.size()) << text;
        for (std::size_t n = 0; n < found.size(); ++n)
            EXPECT_NEAR(distance(found[n], expected[n]), 0, 1e-9) << text << n;
    };
    expect_ends("G1 @1 ^90\n", {{0, 1, 5}});
    expect_ends("G1 @[2*3]^30 Z1\n@2\n^-60\n",
                {{6 * std::sqrt(0.75), 3, 1}, {2 * std::sqrt(0.75), 1, 1}, {1, -2 * std::sqrt(0.75), 1}});
    // The manual's square; a radius that grows as well gives a spiral.
    expect_ends("G1 @.5 ^90\nG91 ^90\n^90\n^90\n^90\n",
                {{0, .5, 5}, {-.5, 0, 5}, {0, -.5, 5}, {.5, 0, 5}, {0, .5, 5}});
    expect_ends("G1 @.5 ^90\nG91 @.5 ^90\n@.5 ^90\n", {{0, .5, 5}, {-1, 0, 5}, {0, -1.5, 5}});
    // About the zero of the work system, in its unit.
    expect_ends("G92 X10 Y20\nG1 @1 ^0\n", {{-9, -20, 5}});
    expect_ends("G20 G1 @1 ^180\n", {{-25.4, 0, 5}});
}

TEST(GcodeReader, AppliesWorkOffsetsThatTheProgramSets) {
    const Program program = program_of(
        "G21 M3 F100\n"
        "G10 L2 P1 X10 Y20\n"
        "G10 L2 P3 Z5\n"
        "G54 G0 X0 Y0 Z0\n"
        "G1 X1\n"
        "G56 X1\n"
        "Z0\n");
    ASSERT_EQ(program.moves.size(), 3U);
    expect_near(program.moves[0].end.tip_mm, {11, 20, 0});
    expect_near(program.moves[1].end.tip_mm, {1, 20, 0});
    expect_near(program.moves[2].end.tip_mm, {1, 20, 5});
    ASSERT_EQ(program.warnings.size(), 1U);
    EXPECT_TRUE(warns_of(program, 4, "zero at X10 Y20 Z0 mm from the stock's origin"));
    EXPECT_TRUE(warns_of(program_of("G21 G55 G0 X0\n"), 1, "G55"));
}

TEST(GcodeReader, RenamesTheToolsPlaceByG92) {
    const Program program = program_of(
        "G21 M3 F100\n"
        "G0 X5 Y5 Z5\n"
        "G92 X0 Y1\n"
        "G1 X2\n"
        "G92.2 X2\n"
        "G92.3 X2\n"
        "G92.1 X2\n");
    ASSERT_EQ(program.moves.size(), 4U);
    expect_near(program.moves[0].end.tip_mm, {7, 5, 5});
    expect_near(program.moves[1].end.tip_mm, {2, 5, 5});
    expect_near(program.moves[2].end.tip_mm, {7, 5, 5});
    expect_near(program.moves[3].end.tip_mm, {2, 5, 5});
}

TEST(GcodeReader, TakesG92AtTheStartAsTheOrigin) {
    const Program program = program_of("G21 M3 F100\nG92 X0 Y0 Z0\nG1 X3\n");
    ASSERT_EQ(program.moves.size(), 1U);
    expect_near(program.moves[0].end.tip_mm, {3, 0, 0});
    EXPECT_TRUE(warns_of(program, 2, "G92"));
}

TEST(GcodeReader, LeavesOutThePathThatOnlyTheMachineKnows) {
    const Program program = program_of(
        "G21 G90 M3 F100\n"
        "G0 X0 Y0 Z5\n"
        "G91 G28 Z0\n"  // from where the tip is
        "G90\n"
        "G53 G0 X-300\n"
        "G0 X1 Y1\n"
        "Z2\n"
        "G1 Z0\n");
    ASSERT_EQ(program.moves.size(), 1U);
    expect_near(program.moves[0].start.tip_mm, {1, 1, 2});
    EXPECT_TRUE(warns_of(program, 3, "G28"));

    // In G90 the way home leads through the point that the block names.
    const Program through = program_of("G21 G0 X0 Y0 Z5\nG28 Z9\n");
    ASSERT_EQ(through.moves.size(), 1U);
    expect_near(through.moves[0].end.tip_mm, {0, 0, 9});
}

TEST(GcodeReader, StartsProgramsThatGoHomeFirst) {
    const Program program = program_of("G21\nG91 G28 Z0.\nG90\nG0 X0 Y0\nG43 Z10 H1\nG0 Z1\n");
    ASSERT_EQ(program.moves.size(), 1U);
    EXPECT_NEAR(rapid_mm(program), 9, 1e-12);
    EXPECT_TRUE(warns_of(program, 5, "G43"));
    EXPECT_EQ(program.warnings.size(), 2U);
}

TEST(GcodeReader, NotesRotaryWordsOnceAndKeepsTheLinearPath) {
    const Program program = program_of("G21 M3 F100\nG0 X0 Y0 Z0\nG1 X1 A10\nX2 B3 C5\n");
    EXPECT_TRUE(program.has_rotary_words);
    EXPECT_EQ(program.first_rotary_line, 3);
    EXPECT_EQ(program.moves.size(), 2U);
    EXPECT_TRUE(warns_of(program, 3, "rotary"));
    EXPECT_EQ(program.warnings.size(), 1U);
    EXPECT_FALSE(program_of("G21 G0 X0 Y0 Z0\nX1").has_rotary_words);
    // At zero, as in programs of posts for four axes, there is nothing to turn.
    const Program zero = program_of("G21 M3 F100\nG28 A0\nG0 X0 Y0 Z0 A0. C0\nG1 X1 A0.\n");
    EXPECT_FALSE(zero.has_rotary_words);
    EXPECT_FALSE(warns_of(zero, 3, "rotary"));
    EXPECT_EQ(program_of("G21 M3 F100\nG0 X0 Y0 Z0 A0\nG1 X1 A5\n").first_rotary_line, 3);
}

TEST(GcodeReader, WarnsOfEachAssumptionOnce) {
    const Program program = program_of("G21 T7\nG0 X0 Y0 Z0\nG1 X1 F100\nX2\nM4 X3\nX4\n");
    EXPECT_TRUE(warns_of(program, 3, "spindle off"));
    EXPECT_TRUE(warns_of(program, 3, "T7 without M6"));
    EXPECT_TRUE(warns_of(program, 5, "backwards"));
    EXPECT_EQ(program.warnings.size(), 3U);
    EXPECT_EQ(program.moves[0].tool, 7);
}

TEST(GcodeReader, ChangesToolsAtM6Only) {
    const Program program = program_of("G21 M3 F100\nT1 M6\nG0 X0 Y0 Z0\nG1 X1 T2\nX2\nM6\nX3\n");
    ASSERT_EQ(program.moves.size(), 3U);
    EXPECT_EQ(program.moves[0].tool, 1);
    EXPECT_EQ(program.moves[1].tool, 1);
    EXPECT_EQ(program.moves[2].tool, 2);
}

TEST(GcodeReader, UsesTheGivenFeedUntilTheFirstF) {
    GcodeOptions options;
    options.default_feed_mm_per_min = 350;
    const Program program = program_of("G21 M3\nG0 X0 Y0 Z0\nG1 X1\nX2 F80\n", options);
    EXPECT_EQ(program.moves[0].feed_mm_per_min, 350);
    EXPECT_EQ(program.moves[1].feed_mm_per_min, 80);
    EXPECT_TRUE(warns_of(program, 3, "350 mm/min"));
}

TEST(GcodeReader, SkipsOrReadsDeletableBlocksAsAsked) {
    const char* const text = "G21 M3 F100\nG0 X0 Y0 Z0\n/G1 X1\n/2 G1 X2\nG1 X3\n";
    const Program skipped = program_of(text);
    EXPECT_EQ(skipped.moves.size(), 1U);
    EXPECT_TRUE(warns_of(skipped, 3, "skipped"));
    GcodeOptions read_all;
    read_all.skip_deletable_blocks = false;
    EXPECT_EQ(program_of(text, read_all).moves.size(), 3U);
}

TEST(GcodeReader, EndsAtM2M30AndTheSecondPercent) {
    for (const char* end : {"M2", "M30", "%"}) {
        const std::string text = std::string("%\nG21 M3 F100\nG0 X0 Y0 Z0\nG1 X1\n") + end + "\nG1 X2\n";
        const Program program = program_of(text);
        EXPECT_EQ(program.moves.size(), 1U) << end;
        EXPECT_TRUE(warns_of(program, 5, "not read")) << end;
    }
    EXPECT_TRUE(program_of("%\nG21 G0 X0 Y0 Z0\nX1\nM30\n%\n").warnings.empty());
}

TEST(GcodeReader, CollectsToolsFromComments) {
    const Program program = program_of(
        "G20\n(T1 D=0.5 CR=0. - ZMIN=-0.25 - flat end mill)\n(T12  D=0.25 CR=0.125)\n(T2 later)\n"
        "(TOOL T3)\nG0 X0 Y0 Z0\nX1\n");
    ASSERT_EQ(program.tools.size(), 2U);
    EXPECT_EQ(program.tools[0].number, 1);
    EXPECT_NEAR(program.tools[0].diameter_mm, 12.7, 1e-12);
    EXPECT_EQ(program.tools[0].line, 2);
    EXPECT_EQ(program.tools[1].number, 12);
    EXPECT_NEAR(program.tools[1].corner_mm, 3.175, 1e-12);
}

TEST(GcodeReader, KeepsTheCommentBesideACallForTheToolThatIsCalled) {
    const Program program = program_of(
        "G21 S9000 M3 F100\nT1 M6 (10 MM END MILL)\nT3 (6 MM BALL MILL)\nG0 X0 Y0 Z0\nG1 X1\nM6\nX2\n");
    ASSERT_EQ(program.tools.size(), 2U);
    EXPECT_EQ(program.tools[0].number, 1);
    EXPECT_NEAR(program.tools[0].diameter_mm, 10, 1e-12);
    EXPECT_EQ(program.tools[1].number, 3);
    EXPECT_NEAR(program.tools[1].diameter_mm, 6, 1e-12);
    EXPECT_NEAR(program.tools[1].corner_mm, 3, 1e-12);
}

TEST(GcodeReader, SaysWhatAPersonForgot) {
    const Program rapids = program_of("G21 F100\nG0 X0 Y0 Z5\nZ-3 F20\nX9\n");
    EXPECT_TRUE(warns_of(rapids, 0, "a G1 may be missing"));
    EXPECT_FALSE(warns_of(program_of("G21 G0 X0 Y0 Z5\nX9\n"), 0, "a G1 may be missing"));
    const Program emptied =
        program_of("G21 M3 F100\nT1 M6 (T1 D=10)\nG0 X0 Y0 Z5\nG1 X9\nT0 M6\nG0 Z9\nG1 X20\nX30\n");
    EXPECT_TRUE(warns_of(emptied, 7, "T0 has put the tool away"));
    EXPECT_FALSE(warns_of(program_of("G21 M3 F100\nT1 M6\nG0 X0 Y0 Z5\nG1 X9\nT0 M6\nG0 Z9\n"), 6, "T0"));
    // CamBam numbers its first tool 0.
    EXPECT_FALSE(warns_of(program_of("G21 M3 F100\n(T0 : 3.0)\n(T1 : 6.0)\nT1 M6\nG0 X0 Y0 Z5\nG1 X9\n"
                                     "T0 M6\nG1 X20\n"),
                          8, "T0"));
    const auto ends = read_gcode("%NAME\n%Version 1\nG21 G0 X0 Y0 Z0\n", {});
    ASSERT_FALSE(ends.has_value());
    EXPECT_EQ(ends.error().line, 2);
}

// The unit is stated behind the billet.
TEST(GcodeReader, TakesTheBilletAndTheToolsOfADenfordMill) {
    const Program program = program_of(
        "[BILLET X3 Y5 Z.75\n[edgemove x-0.5 y-1\n[TOOLDEF T01 D.5 Z2;\nG20 M3 F10\nT1 M6\nG0 X0 Y0 Z0\nG1 "
        "X1\n");
    ASSERT_TRUE(program.stock.has_value());
    EXPECT_EQ(program.stock->line, 1);
    expect_near(program.stock->box_mm.min, {-12.7, -25.4, -19.05});
    expect_near(program.stock->box_mm.max, {63.5, 101.6, 0});
    ASSERT_EQ(program.tools.size(), 1U);
    EXPECT_NEAR(program.tools[0].diameter_mm, 12.7, 1e-12);
    EXPECT_FALSE(read_gcode("[BILLET X1e300 Y5 Z1\nG21 G0 X0 Y0 Z0\n", {}));
    EXPECT_FALSE(read_gcode("[TOOLDEF D5\nG21 G0 X0 Y0 Z0\n", {}));
    EXPECT_FALSE(read_gcode("[TOOLDEF T-1 D5\nG21 G0 X0 Y0 Z0\n", {}));
    EXPECT_FALSE(read_gcode("[EDGEMOVE X5\nG21 G0 X0 Y0 Z0\n", {}));
}

TEST(GcodeReader, AcceptsModesThatDoNotMoveTheTool) {
    const Program program = program_of(
        "G21 G90 G94 G17 G40 G49 G80 G54 G64 P0.01 Q0.01 G97 G98 G91.1 G15 G69\n"
        "M8 M7\nM48\nM50 P0\nM19 R90\nM64 P1\nM67 E0 Q1\nG61\nM3 S100\nG0 X0 Y0 Z0\nG1 X1 F10 "
        "M9\nM0\nM1\nM5\nM30\n");
    EXPECT_EQ(program.moves.size(), 1U);
    EXPECT_TRUE(program.warnings.empty());
}

}  // namespace
}  // namespace tribo::readers
