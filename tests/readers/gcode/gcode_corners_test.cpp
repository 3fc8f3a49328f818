// SPDX-License-Identifier: MIT
// Corners of blocks, round pockets, cylinders and modal macros: lengths and places in closed form.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "readers/gcode/gcode_text.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

motion::Program fanuc(const std::string& text, GcodeOptions options = {}) {
    options.dialect = GcodeDialect::fanuc;
    return program_of("G21 G90 G54 M3 S1000 F100\nG0 X0 Y0 Z0\n" + text, options);
}

TEST(GcodeCorners, round_and_cut_the_end_of_a_block) {
    // Each arc of 5 mm takes 5 mm from both sides; each chamfer 2 mm.
    const motion::Program round = fanuc("G1 X40 ,R5\nY40 ,C2\nX0\n");
    EXPECT_NEAR(feed_mm(round), 35 + 5 * kPi / 2 + 33 + 2 * std::sqrt(2.0) + 38, 1e-9);
    ASSERT_EQ(round.moves.size(), 5U);
    EXPECT_LT(distance(round.moves[1].arc->centre_mm, {35, 5, 0}), 1e-9);
    EXPECT_EQ(round.moves[1].line, 3);
    EXPECT_LT(distance(round.moves[3].end.tip_mm, {38, 40, 0}), 1e-9);
    // Fagor writes the same as G36 and G39.
    EXPECT_NEAR(feed_mm(fanuc("G1 G36 R5 X40\nG39 R2 Y40\nX0\n")), feed_mm(round), 1e-9);
    // A chamfer may take the whole of a move.
    EXPECT_NEAR(feed_mm(fanuc("G1 X40\nY8 ,C8\nX0\n")), 40 + std::hypot(8, 8) + 32, 1e-9);
    // Both are scaled with the path.
    EXPECT_NEAR(feed_mm(fanuc("G51 X0 Y0 Z0 P2000\nG1 X40 ,R5\nY40 ,C2\nX0\nG50\n")), 2 * feed_mm(round),
                1e-9);
    // Straight on there is no corner.
    EXPECT_NEAR(feed_mm(fanuc("G1 X40 ,R5\nX60\n")), 60, 1e-9);
}

TEST(GcodeCorners, are_offset_by_the_cutter_too) {
    GcodeOptions options;
    options.tools = {{1, 6}};
    // Inside, the arc of 5 mm becomes one of 2 mm.
    const motion::Program program = fanuc("T1 M6\nG41 D1 G1 X10\nX50 ,R5\nY40\nG40 Y60\n", options);
    const auto arc = std::find_if(program.moves.begin(), program.moves.end(),
                                  [](const motion::Move& move) { return move.arc.has_value(); });
    ASSERT_NE(arc, program.moves.end());
    EXPECT_NEAR(distance(arc->arc->centre_mm, arc->start.tip_mm), 2, 1e-9);
    EXPECT_LT(distance(arc->arc->centre_mm, {45, 5, 0}), 1e-9);
}

// Feed length of moves along the sides of a rectangle about the middle, at a height.
double along_sides_mm(const motion::Program& program, double half_x, double half_y, double z) {
    double sum = 0;
    for (const motion::Move& move : program.moves) {
        const Vec3 a = move.start.tip_mm, b = move.end.tip_mm;
        if (move.kind != motion::MoveKind::feed || std::abs(a.z - z) > 1e-9 || std::abs(b.z - z) > 1e-9)
            continue;
        const bool on_x = std::abs(std::abs(a.x) - half_x) < 1e-9 && std::abs(a.x - b.x) < 1e-9;
        const bool on_y = std::abs(std::abs(a.y) - half_y) < 1e-9 && std::abs(a.y - b.y) < 1e-9;
        if (on_x || on_y) sum += distance(a, b);
    }
    return sum;
}

TEST(GcodePocket, follows_the_contour_of_a_subprogram) {
    GcodeOptions options;
    options.tools = {{1, 10}};
    // 40 by 20 mm, entered from the middle to its upper side. K leaves 1 mm, which is cut at the bottom
    // alone.
    const std::string contour = "G1 Y10\nX-20\nY-10\nX20\nY10\nX0\nM99\n";
    const std::string block = "G150 X0 Y0 Z-4 R0 Q2 I3 K1 D1 P100 ";
    for (const std::string& text : {"T1 M6\n" + block + "G41\nG40\nG0 Z9\nM30\nN100 " + contour,
                                    "T1 M6\n" + block + "G42\nM30\nO100\n" + contour}) {
        const motion::Program program = fanuc(text, options);
        for (const double z : {-2.0, -4.0}) {
            EXPECT_NEAR(along_sides_mm(program, 14, 4, z), 4 * (14 + 4), 1e-9);
            EXPECT_NEAR(along_sides_mm(program, 11, 1, z), 4 * (11 + 1), 1e-9);
        }
        EXPECT_NEAR(along_sides_mm(program, 15, 5, -4), 4 * (15 + 5), 1e-9);
        EXPECT_EQ(along_sides_mm(program, 15, 5, -2), 0);
        for (const motion::Move& move : program.moves) {
            EXPECT_LE(std::abs(move.end.tip_mm.x), 15 + 1e-9);
            EXPECT_LE(std::abs(move.end.tip_mm.y), 5 + 1e-9);
        }
        EXPECT_TRUE(warns_of(program, 4, "G150: the way of the tool is the control's own"));
    }
    // Without G41 and G42 the contour is that of the tool's centre.
    const motion::Program centre = fanuc("T1 M6\n" + block + "\nM30\nN100 " + contour, options);
    Vec3 widest;
    for (const motion::Move& move : centre.moves) {
        for (int k = 0; k < 3; ++k) widest[k] = std::max(widest[k], std::abs(move.end.tip_mm[k]));
    }
    EXPECT_LT(distance(widest, {20, 10, 4}), 1e-5);
}

RC_GTEST_PROP(GcodeCorners, an_arc_between_lines_touches_both, ()) {
    const double degrees = *rc::gen::inRange(20, 161) * (*rc::gen::arbitrary<bool>() ? 1 : -1);
    const double radius = *rc::gen::inRange(1, 100) / 10.0;
    const double x = 200 + 200 * std::cos(degrees * kPi / 180), y = 200 * std::sin(degrees * kPi / 180);
    const motion::Program program = fanuc("G1 X200 ,R" + short_decimal(radius) + "\nX" + short_decimal(x, 9) +
                                          " Y" + short_decimal(y, 9) + "\n");
    // Each side loses r tan(turn / 2), and the arc turns as the sides do.
    const double turn = std::abs(degrees) * kPi / 180;
    RC_ASSERT(std::abs(feed_mm(program) - (400 - 2 * radius * std::tan(turn / 2) + radius * turn)) < 1e-6);
}

TEST(GcodeRoundPocket, goes_out_by_half_circles_and_back_to_the_middle) {
    GcodeOptions options;
    options.tools = {{1, 4}};
    // Circles of radius 3, 5 and 6 of the tool's centre.
    const motion::Program program = fanuc("T1 M6\nG13 D1 I5 K8 Q2 Z-2\n", options);
    EXPECT_NEAR(feed_mm(program),
                2 + kPi * 1.5 + 2 * kPi * 3 + kPi * 3.5 + kPi * 4.5 + 2 * kPi * 5 + kPi * 5.25 + kPi * 5.75 +
                    2 * kPi * 6 + kPi * 3,
                1e-9);
    EXPECT_LT(distance(program.moves.back().end.tip_mm, {0, 0, -2}), 1e-9);
    EXPECT_NEAR(program.moves[1].arc->normal.z, 1, 1e-12);
    // D0: the circles of the tool's centre. L repeats the depth of G91.
    const motion::Program deep = fanuc("T1 M6\nG91 G12 D0 I5 Z-2 L3\n", options);
    EXPECT_NEAR(feed_mm(deep), 3 * (2 + kPi * 5 + 2 * kPi * 5), 1e-9);
    EXPECT_LT(distance(deep.moves.back().end.tip_mm, {0, 0, -6}), 1e-9);
    EXPECT_NEAR(deep.moves[1].arc->normal.z, -1, 1e-12);
    // By any text about the tool; the first circle is the tool's own: one circle of radius 1 of its centre.
    const motion::Program own = fanuc("(T2 = 4 MM END MILL)\nT2 M6\nG13 D2 I2 K3 Q2 Z-2\n");
    EXPECT_NEAR(feed_mm(own), 2 + kPi + 2 * kPi, 1e-9);
    // A first circle within the tool, as Haas's own workbook has it: the next one is that of radius 1.
    const motion::Program within = fanuc("(T2 = 4 MM END MILL)\nT2 M6\nG13 D2 I1 K3 Q1 Z-2\n");
    EXPECT_NEAR(feed_mm(within), 2 + kPi + 2 * kPi, 1e-9);
    EXPECT_TRUE(warns_of(within, 5, "I is smaller than the tool's radius"));
}

TEST(GcodeCylinder, rolls_lines_and_arcs_about_its_axis) {
    const motion::Machine machine = *motion::named_machine("xyza");
    GcodeOptions options;
    options.machine = &machine;
    // A quarter turn of a cylinder of 20 mm, 10 mm along it.
    const motion::Program line = fanuc("G1 Z20\nG7.1 A20\nX10 A90\nG7.1 A0\n", options);
    const double whole = std::hypot(10, 10 * kPi);
    EXPECT_NEAR(feed_mm(line), 20 + whole, 1e-3);
    double time_s = 0;
    for (const motion::Move& move : line.moves) {
        if (move.line == 5) time_s += move.duration_s;
    }
    EXPECT_NEAR(time_s, 60 * whole / 100, 1e-6);
    for (const motion::Move& move : line.moves) {
        if (move.line != 5) continue;
        EXPECT_NEAR(std::hypot(move.end.tip_mm.y, move.end.tip_mm.z), 20, 1e-3);
    }
    // A half circle of 5 mm on the unrolled surface ends 10 mm further on.
    const motion::Program arc = fanuc("G1 Z20\nG7.1 A20\nG2 X10 A0 R5\n", options);
    EXPECT_NEAR(feed_mm(arc), 20 + 5 * kPi, 1e-2);
    const motion::Program alone = fanuc("G1 Z20\nG7.1 A20\nX10 A90\n");
    EXPECT_TRUE(alone.has_rotary_words);
    EXPECT_TRUE(warns_of(alone, 4, "the program needs a machine to be understood"));
}

TEST(GcodeMacro, g66_calls_after_each_move_until_g67) {
    const motion::Program program =
        fanuc("G66 P9 Z-3 R1\nG0 X10\nX20 Y5\nG67\nX30\nM30\nO9\nG1 Z#26\nG0 Z#18\nM99\n");
    std::vector<Vec3> bottoms;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed) bottoms.push_back(move.end.tip_mm);
    }
    ASSERT_EQ(bottoms.size(), 2U);
    EXPECT_LT(distance(bottoms[0], {10, 0, -3}), 1e-12);
    EXPECT_LT(distance(bottoms[1], {20, 5, -3}), 1e-12);
}

TEST(GcodeLenient, passes_over_a_second_tool_and_the_number_of_a_spindle) {
    const motion::Program program = fanuc("T3 T4 M6\nG1 X5\nS500 $0\n");
    EXPECT_EQ(program.moves.at(0).tool, 3);
    EXPECT_TRUE(warns_of(program, 3, "the tool after this one"));
}

TEST(GcodeLenient, leaves_out_the_programs_of_the_machine) {
    const motion::Program program = fanuc(
        "G1 X5\nG65 P9810 Z1. F50.\nG1 X10\nG0 X0 Y0 Z0\nG65 P9810 Z1.\nM98 P8999\nG0 X0 Y0 Z0\nG1 X3\n");
    EXPECT_NEAR(feed_mm(program), 8, 1e-12);
    EXPECT_TRUE(warns_of(program, 4, "O9810 is a program of the machine's own"));
    EXPECT_TRUE(warns_of(program, 8, "O8999 is a program of the machine's own"));
    // One that the text has is run; another one that it lacks is refused.
    EXPECT_NEAR(feed_mm(fanuc("M98 P9001\nM30\nO9001\nG1 X4\nM99\n")), 4, 1e-12);
    EXPECT_FALSE(read_gcode("G21\nM98 P7999\n").has_value());
}

TEST(GcodeLenient, saves_and_restores_modes) {
    const motion::Program program =
        program_of("G21 G90 M3 F100\nG0 X0 Y0 Z0\nM70\nG91 F7 G20\nG1 X1\nM72\nG1 X10\nM71\nM72\nX5\n");
    EXPECT_NEAR(feed_mm(program), 25.4 + 15.4 + 5, 1e-9);
    EXPECT_DOUBLE_EQ(program.moves.back().feed_mm_per_min, 100);
}

TEST(GcodeLenient, taps_rigidly_to_the_end_and_back) {
    const motion::Program program = program_of("G21 M3 S500\nG0 X0 Y0 Z5\nG33.1 Z-5 K1.5\n");
    EXPECT_NEAR(feed_mm(program), 20, 1e-12);
    EXPECT_DOUBLE_EQ(program.moves.back().feed_mm_per_min, 750);
    EXPECT_EQ(program.moves.back().end.tip_mm, (Vec3{0, 0, 5}));
}

TEST(GcodeLenient, takes_a_and_b_of_g68_as_its_centre) {
    const motion::Program program = program_of("G21 M3 F9\nG0 X0 Y0 Z0\nG68 A10 B0 R90\nG1 X20 Y0\n");
    EXPECT_LT(distance(program.moves.back().end.tip_mm, {10, 10, 0}), 1e-9);
    EXPECT_TRUE(warns_of(program, 3, "the centre of its rotation (Mach3)"));
}

TEST(GcodeLenient, keeps_the_words_of_a_cycle_that_is_not_repeated) {
    EXPECT_NEAR(feed_mm(fanuc("G99 G81 X5 Y5 Z-3 R2 L0\nX9\n")), 5, 1e-12);
}

}  // namespace
}  // namespace tribo::readers
