// SPDX-License-Identifier: MIT
// Ends of moves as rs274 of linuxcnc-uspace 2.9.0~pre1 gives them for the same text.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include "readers/gcode/gcode_text.hpp"
#include "readers/gcode/motion/offsets.hpp"

namespace tribo::readers {
namespace {

std::vector<Vec3> ends_of(const std::string& text, const GcodeOptions& options = {}) {
    std::vector<Vec3> ends;
    for (const auto& move : program_of("G21 G90 M3 F100\nG0 X0 Y0 Z5\nG1 X5 Y3\n" + text, options).moves) {
        ends.push_back(move.end.tip_mm);
    }
    ends.erase(ends.begin());
    return ends;
}

void expect_ends(const std::string& text, const std::vector<Vec3>& expected) {
    const std::vector<Vec3> ends = ends_of(text);
    ASSERT_EQ(ends.size(), expected.size()) << text;
    for (std::size_t i = 0; i < ends.size(); ++i) expect_near(ends[i], expected[i], 1e-9);
}

TEST(GcodeOffsets, G52ShiftsTheZeroUntilItIsZeroAgain) {
    expect_ends("G52 X1 Y2\nX3\nY5\nG52 X0 Y0\nX9\n", {{4, 3, 5}, {4, 7, 5}, {9, 7, 5}});
}

TEST(GcodeOffsets, G92AndG52ShareTheirRegisters) {
    expect_ends("G92 X3\nX4\nG52 X1\nX4\nG92.1\nX7\n", {{6, 3, 5}, {5, 3, 5}, {7, 3, 5}});
}

TEST(GcodeOffsets, G92ComesAndGoes) {
    expect_ends("G92 X10 Y2\nX12\nG92.2\nX1\nG92.3\nX2\nG92.1\nX3\n",
                {{7, 3, 5}, {1, 3, 5}, {-3, 3, 5}, {3, 3, 5}});
}

TEST(GcodeOffsets, G10L20GivesTheTipItsCoordinates) {
    // The tip at 5, 3, 5 is now 1, 1, 2.
    expect_ends("G10 L20 P1 X1 Y1 Z2\nX3 Y0 Z0\n", {{7, 2, 3}});
    expect_ends("G10 L20 P2 X0\nG55 X1\n", {{6, 3, 5}});
    // G92 stays on top of it.
    expect_ends("G92 X0\nG10 L20 P1 X1\nX0\n", {{4, 3, 5}});
}

TEST(GcodeOffsets, G10L2RTurnsTheWorkSystem) {
    const double c = std::cos(std::acos(-1.0) / 6), s = 0.5;  // 30 degrees
    // Coordinates that a block leaves out are those that the tip has in the turned axes.
    const double y = 3 * c - 5 * s;
    expect_ends("G10 L2 P1 R30\nX3\nX0 Y0\nX2\n",
                {{3 * c - y * s, 3 * s + y * c, 5}, {0, 0, 5}, {2 * c, 2 * s, 5}});
    // Arcs, cycles and increments turn with it.
    expect_ends("G10 L2 P1 R90\nX2 Y0\nG3 X0 Y2 I-2\nG91 G1 X1\n", {{0, 2, 5}, {-2, 0, 5}, {-2, 1, 5}});
    // G54 straight, G55 turned by -90 degrees about 1, 2.
    expect_ends("G10 L2 P2 X1 Y2 R-90\nG55 X3 Y0\nG54 X0 Y0\n", {{1, -1, 5}, {0, 0, 5}});
    const motion::Program program =
        program_of("G21 M3 F100\nG10 L2 P1 R90\nG0 X2 Y0 Z0\nG3 X0 Y2 I-2\nG18 G2 X2 Z2 I2\n");
    ASSERT_EQ(program.moves.size(), 2U);
    EXPECT_NEAR(motion::path_length_mm(program.moves[0]), std::acos(-1.0), 1e-9);
    expect_near(program.moves[1].arc->normal, {1, 0, 0}, 1e-12);
}

TEST(GcodeOffsets, FanucStatesWorkSystemsFromTheMachineAndTheStockStandsAtTheFirst) {
    GcodeOptions fanuc;
    fanuc.dialect = GcodeDialect::fanuc;
    const std::string two = "G21 M3 F100\nG10 L2 P1 X-400 Y-200 Z-300\nG10 L2 P2 X-290 Y-200 Z-301\n";
    const motion::Program both = program_of(two + "G0 X0 Y0 Z5\nG1 X1\nG55 X0 Y0 Z5\n", fanuc);
    ASSERT_EQ(both.moves.size(), 2U);
    expect_near(both.moves[0].end.tip_mm, {1, 0, 5});
    expect_near(both.moves[1].end.tip_mm, {110, 0, 4});
    EXPECT_TRUE(warns_of(both, 4, "taken at the zero of that work system"));
    EXPECT_TRUE(warns_of(both, 6, "zero at X110 Y0 Z-1 mm from the stock's origin"));
    // In G91 the values are added: three parts in a row.
    const motion::Program row = program_of(
        "G21 M3 F100\nG0 X0 Y0 Z5\nG91 G10 L2 P1 X50\nG90 G1 X0\nG91 G10 L2 P1 X50\nG90 G1 X0\n", fanuc);
    ASSERT_EQ(row.moves.size(), 2u);
    expect_near(row.moves[0].end.tip_mm, {50, 0, 5});
    expect_near(row.moves[1].end.tip_mm, {100, 0, 5});
    // The way home before them names no place; the system that the program begins in counts, not the first.
    const motion::Program second = program_of(
        "G21 M3 F100\nG90 G28 X0 Y0 Z0\n#5241=-30\nG55 G0 X0 Y0 Z5\nG1 X1\nX#5241\nG92 X0\nX2\n", fanuc);
    ASSERT_EQ(second.moves.size(), 3U);
    expect_near(second.moves[0].end.tip_mm, {1, 0, 5});
    expect_near(second.moves[1].end.tip_mm, {-30, 0, 5});
    expect_near(second.moves[2].end.tip_mm, {-28, 0, 5});
}

TEST(GcodeOffsets, ToolLengthsOutOfTheProgramMoveNoTip) {
    expect_ends("G43.1 Z20\nX6\nG49\nX7\n", {{6, 3, 5}, {7, 3, 5}});
    EXPECT_TRUE(warns_of(program_of("G21 G0 X0 Y0 Z0\nG43.1 Z3\nX1\n"), 2, "G43.1"));
}

TEST(GcodeReader, StreamsTheSameMovesThatItCollects) {
    class Collected : public MoveSink {
      public:
        void take(const motion::Move& move) override { moves.push_back(move); }
        std::vector<motion::Move> moves;
    };
    const std::string text =
        "G21 M3 F100\nG10 L2 P1 R10\nG0 X0 Y0 Z0\nG41.1 D1\nG1 X10\nY5\nG40 X0\nG5 X9 I1 J1 P1 Q1\n";
    Collected sink;
    const auto streamed = read_gcode(text, {}, sink);
    ASSERT_TRUE(streamed.has_value());
    const motion::Program whole = program_of(text);
    EXPECT_TRUE(streamed->moves.empty());
    ASSERT_EQ(sink.moves.size(), whole.moves.size());
    for (std::size_t i = 0; i < whole.moves.size(); ++i) {
        EXPECT_EQ(sink.moves[i].end, whole.moves[i].end);
        EXPECT_EQ(sink.moves[i].line, whole.moves[i].line);
    }
}

// The tool is at 5, 3, 5, and U V W are at 0.
TEST(GcodeParallelAxes, TheTipStandsAtTheSum) {
    expect_ends("W-2\nX6 W-3\nZ1\nW0\n", {{5, 3, 3}, {6, 3, 2}, {6, 3, -2}, {6, 3, 1}});
    expect_ends("G91\nW-1\nW-1 Z1\nG90\nZ0\n", {{5, 3, 4}, {5, 3, -2}});
    expect_ends("G0 U1 V2\nG1 X0\nG20 W-1\n", {{6, 5, 5}, {1, 5, 5}, {1, 5, -20.4}});
    // Centres that are absolute, and circles, lie in the shifted coordinates.
    expect_ends("U10\nX0 Y0\nG90.1 G2 X2 Y0 I1 J0\n", {{15, 3, 5}, {10, 0, 5}, {12, 0, 5}});
}

TEST(GcodeParallelAxes, G92AndG28) {
    expect_ends("W-2\nG92 W0\nW1\nZ0\n", {{5, 3, 3}, {5, 3, 4}, {5, 3, -1}});
    // W goes back to where it was at the start.
    expect_ends("W-2\nG28 W0\nG0 Z4\nZ5\n", {{5, 3, 3}, {5, 3, 5}});
    expect_ends("W-2\nG53 W0\nG0 Z4\nZ5\n", {{5, 3, 3}, {5, 3, 5}});
    expect_ends("W-2\nG91 G28 Z0\nG90 G0 Z4\nZ5\n", {{5, 3, 3}, {5, 3, 3}});
}

// Random words of all six axes: the tip is at the sum, whatever stands in one block.
TEST(GcodeParallelAxes, AnyWordsAddUp) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> draw(-50, 50);
    for (int n = 0; n < 300; ++n) {
        Vec3 beside, main{5, 3, 5};
        std::string text;
        std::vector<Vec3> expected;
        for (int block = 0; block < 6; ++block) {
            const bool incremental = draw(random) > 0;
            text += incremental ? "G91" : "G90";
            for (int axis = 0; axis < 3; ++axis) {
                for (const bool is_beside : {false, true}) {
                    // Not X Y U V in one block: a hot wire.
                    if (draw(random) > 0 || (is_beside && axis == 1)) continue;
                    const int mm = draw(random);
                    text += (is_beside ? "UVW" : "XYZ")[axis] + std::to_string(mm);
                    double& place = (is_beside ? beside : main)[axis];
                    place = mm + (incremental ? place : 0);
                }
            }
            text += "\n";
            const Vec3 before = expected.empty() ? Vec3{5, 3, 5} : expected.back();
            if (main + beside != before) expected.push_back(main + beside);
        }
        expect_ends(text, expected);
    }
}

TEST(GcodeParallelAxes, AreRefusedWhereTheyMeanSomethingElse) {
    const auto refused = [](const std::string& text, const std::string& why) {
        const auto program = read_gcode("G21 M3 F100\nG0 X0 Y0 Z5\n" + text);
        ASSERT_FALSE(program) << text;
        EXPECT_NE(program.error().cause.find(why), std::string::npos) << program.error().text();
    };
    refused("G1 X1 Y2 U1 V2\n", "hot wire");
    refused("G2 X5 I2.5 W-1\n", "an arc");
    refused("G81 X5 Z-3 R1 W-1\n", "a cycle");
    refused("G81 X5 Z-3 R1\nW-1\n", "a cycle");
    refused("G68 R10\nG1 W-1\n", "turned");
    const auto lathe = read_gcode("G21 M3 F100\nG0 X0 Z5\nG1 U-1 W-2\n");
    ASSERT_FALSE(lathe);
    EXPECT_NE(lathe.error().cause.find("lathe"), std::string::npos);
    // Said once each.
    const motion::Program program = program_of("G21 M3 F100\nG0 X0 Y0 Z5\nG1 W-1\nW-2 U1\n");
    EXPECT_EQ(
        std::ranges::count_if(program.warnings,
                              [](const Warning& w) { return w.text.find("parallel") != std::string::npos; }),
        2);
}

}  // namespace
}  // namespace tribo::readers
