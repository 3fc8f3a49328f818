// SPDX-License-Identifier: MIT
// Ends of moves as rs274 of linuxcnc-uspace 2.9.0~pre1 gives them for the same text.
#include <cmath>
#include <gtest/gtest.h>
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

}  // namespace
}  // namespace tribo::readers
