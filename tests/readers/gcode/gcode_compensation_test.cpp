// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>
#include <string>

#include "motion/program_summary.hpp"
#include "readers/gcode/gcode_text.hpp"
#include "readers/gcode/motion/compensation.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

using motion::Program;
using std::numbers::pi;

// After a rapid to X0 Y0 Z5. Number, length and box of the feed moves are those of LinuxCNC's interpreter:
// made with rs274_path.py and linuxcnc-uspace 2.9.0~pre1 (arcs in the box at 1/720 of a turn).
struct Contour {
    const char* name;
    const char* text;
    std::size_t feed_moves;
    double feed_mm;
    double least[2], most[2];
};

TEST(GcodeCompensation, FollowsThePathsOfLinuxcnc) {
    const Contour contours[] = {
        {"inside of a rectangle",
         "G41.1 D2\nG1 X5 Y0\nY10\nX-10\nY-5\nX20\nG40 X30\n",
         6,
         77.1729812,
         {-9, -5},
         {30, 9}},
        {"outside of a rectangle",
         "G42.1 D2\nG1 X5 Y0\nY10\nX-10\nY-5\nX20\nG40 X30\n",
         10,
         91.4320804,
         {-11, -6},
         {30, 11}},
        {"moves along the tool wait for the corner",
         "G41.1 D2\nG1 X5 Y0\nZ-1\nY10\nG0 Z3\nG1 Z-1\nX-10\nX-10 Y20 Z3\nG40\nG0 Z5\n",
         7,
         48.4642316,
         {-11, 0},
         {4, 20}},
        {"tangent lines and arcs, left",
         "G41.1 D2\nG1 X10\nG3 X0 Y10 I-10\nG1 Y20\nG2 X10 Y30 I10\nX20 Y20 J-10\nG1 X0\nG40 Y40\n",
         9,
         110.8342097,
         {-1, 0},
         {21, 40}},
        {"tangent lines and arcs, right",
         "G42.1 D2\nG1 X10\nG3 X0 Y10 I-10\nG1 Y20\nG2 X10 Y30 I10\nX20 Y20 J-10\nG1 X0\nG40 Y40\n",
         8,
         102.1601345,
         {0, -1},
         {18.944272, 40}},
        {"corners of lines and arcs, left",
         "G41.1 D2\nG1 X10\nX20 Y5\nG3 X30 Y5 I5\nG1 X40 Y0\nG3 X50 Y0 I5 Z-1\nG3 X60 I5\nG40 G1 X70\n",
         11,
         90.3152785,
         {0, -4},
         {70, 6}},
        {"corners of lines and arcs, right",
         "G42.1 D2\nG1 X10\nX20 Y5\nG3 X30 Y5 I5\nG1 X40 Y0\nG3 X50 Y0 I5 Z-1\nG3 X60 I5\nG40 G1 X70\n",
         8,
         85.4834621,
         {0, -5.999992},
         {70, 3.479849}},
        {"entry on an arc, left",
         "G41.1 D2\nG2 X10 Y10 I10\nG1 X20\nY0\nG40 X0\n",
         5,
         59.3061472,
         {-0.045454, 0},
         {21, 11}},
        {"entry on an arc, right",
         "G42.1 D2\nG2 X10 Y10 I10\nG1 X20\nY0\nG40 X0\n",
         4,
         51.7377259,
         {0, 0},
         {19, 9}},
        {"back along the same line", "G41.1 D2\nG1 X10\nX0\nY5\n", 5, 29.7622646, {-1, -1}, {11, 5}},
        {"rapids too", "G42.1 D2\nG0 X10\nY5\nX0\nG1 Y20\nG40 X50\n", 2, 63, {1, 6}, {50, 20}},
        {"inside corner of two arcs",
         "G41.1 D2\nG1 X10\nG2 X20 I5\nG2 X10 I-5\nG3 X10 Y0 I-5\nG40 G1 X-20\n",
         5,
         99.9659614,
         {-20, -6},
         {21, 5.999996}},
        {"in the ZX plane", "G18 G41.1 D2\nG1 X10\nZ10\nX20\nG40 X30\n", 5, 34.6705476, {0, 0}, {30, 0}},
        {"in increments", "G41.1 D2\nG91 G1 X10\nY10\nX10 Y2\nG40 X5\nY5\n", 6, 39.9146564, {0, 0}, {25, 17}},
        {"twice",
         "G41.1 D2\nG1 X10\nX20\nG40\nG41.1 D4\nG1 Y10\nX50\nG40 X60\n",
         6,
         72.6090518,
         {0, 0},
         {60, 12}},
        {"an arc and back",
         "G41.1 D2\nG1 X10\nG2 X20 I5\nX10 I-5\nG40 G1 X0\n",
         4,
         54.8332201,
         {0, -6},
         {21, 5.999996}},
    };
    for (const Contour& c : contours) {
        const Program program =
            program_of(std::string("G21 G90 G94 G17\nF100 S1000 M3\nG0 X0 Y0 Z5\n") + c.text);
        const motion::ProgramSummary summary = motion::testing::summary_of(program);
        EXPECT_EQ(summary.feed_moves, c.feed_moves) << c.name;
        EXPECT_NEAR(summary.path_mm, c.feed_mm, 1e-6) << c.name;
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_NEAR(summary.bounds_mm.min[axis], c.least[axis], 1e-4) << c.name;
            EXPECT_NEAR(summary.bounds_mm.max[axis], c.most[axis], 1e-4) << c.name;
        }
        for (std::size_t i = 1; i < program.moves.size(); ++i) {
            expect_near(program.moves[i].start.tip_mm, program.moves[i - 1].end.tip_mm, 1e-9);
        }
    }
}

TEST(GcodeCompensation, TakesTheDiameterFromOptionsTableAndComments) {
    const std::string contour = "G1 X5 Y0 F100\nX10\n";
    const auto aside = [&](const std::string& code, const GcodeOptions& options = {}) {
        return program_of("G21 M3\nG0 X0 Y0 Z0\n" + code + "\n" + contour, options).moves.back().end.tip_mm.y;
    };
    GcodeOptions options;
    options.tools = {{3, 6}};
    EXPECT_NEAR(aside("G41 D3", options), 3, 1e-12);
    EXPECT_NEAR(aside("T3 M6\nG42", options), -3, 1e-12);
    EXPECT_NEAR(aside("(T4 D=2.)\nT4 M6\nG41"), 1, 1e-12);
    EXPECT_NEAR(aside("(T3 D=2.)\nG41 D3", options), 3, 1e-12);  // the options win
    EXPECT_NEAR(aside("G10 L1 P7 R1.5\nG41 D7"), 1.5, 1e-12);
    EXPECT_NEAR(aside("G42.1 D4"), -2, 1e-12);
    EXPECT_NEAR(aside("G41 D0"), 0, 1e-12);
}

// The wall behind an inside corner is cut from its beginning on; an outside corner and a tangent are as ever.
TEST(GcodeCompensation, BeginsSquareToTheSecondBlockOnAFanuc) {
    const auto begins = [](const std::string& moves, GcodeDialect dialect) {
        GcodeOptions options;
        options.dialect = dialect;
        options.tools = {{1, 20}};
        const Program program = program_of(
            "G21 G90 G94 M3 S1000 F100\nG0 X-50 Y-20 Z0\nG41 D1\nG1 " + moves + "G40 X-90\n", options);
        for (std::size_t i = 1; i < program.moves.size(); ++i)
            expect_near(program.moves[i].start.tip_mm, program.moves[i - 1].end.tip_mm, 1e-9);
        return program.moves.front().end.tip_mm;
    };
    const std::string inside = "X0 Y-20\nY30\n", oblique = "X0 Y0\nY30\n",
                      arc = "X0 Y-20\nG3 X0 Y30 J25\nG1 ";
    expect_near(begins(inside, GcodeDialect::linuxcnc), {-10, -10, 0}, 1e-9);
    expect_near(begins(inside, GcodeDialect::fanuc), {-10, -20, 0}, 1e-9);
    expect_near(begins(oblique, GcodeDialect::fanuc), {-10, 0, 0}, 1e-9);
    expect_near(begins("X0 Y-20\nZ-1\nY30\n", GcodeDialect::fanuc), {-10, -20, 0}, 1e-9);
    for (const GcodeDialect dialect : {GcodeDialect::linuxcnc, GcodeDialect::fanuc}) {
        expect_near(begins(arc, dialect), {0, -10, 0}, 1e-9);
        expect_near(begins("X0 Y-20\nY-60\n", dialect), {0, -10, 0}, 1e-9);
    }
}

// Fanuc refuses it; here the arc and the wall behind it are shortened, as ever.
TEST(GcodeCompensation, AfterAnArcInTheFanucDialectStaysOnTheArc) {
    const auto milled = [](GcodeDialect dialect) {
        GcodeOptions options;
        options.dialect = dialect;
        options.tools = {{1, 4}};
        return program_of(
            "G21 G90 M3 S1000 F100\nG0 X-50 Y0 Z0\nG41 D1\nG3 X0 Y0 I25\nG1 X-10 Y30\nG40 X-90\n", options);
    };
    const Program program = milled(GcodeDialect::fanuc);
    ASSERT_TRUE(program.moves.front().arc);
    const motion::Move& arc = program.moves.front();
    EXPECT_NEAR(distance(arc.end.tip_mm, arc.arc->centre_mm), distance(arc.start.tip_mm, arc.arc->centre_mm),
                1e-9);
    expect_near(arc.end.tip_mm, milled(GcodeDialect::linuxcnc).moves.front().end.tip_mm, 1e-12);
}

// T D=16 of Fusion is the whole diameter, or D corrects the wear alone: the contour tells.
TEST(GcodeCompensation, TakesTheProgrammedPathWhereTheDiameterOfACommentDoesNotFit) {
    const auto milled = [](const std::string& moves, const std::string& more = "") {
        return program_of("(T8 D=16. CR=0. - FLAT END MILL" + more +
                          ")\nG21 G90 M3 F100\nT8 M6\nG0 X0 Y0 Z0\n" + moves);
    };
    // A square of 60 mm from outside, with an entry of 30 mm: 8 mm aside.
    const std::string square = "G41 D8\nG1 X30 Y0\nY60\nX90\nY0\nX30\nG40 X0\n";
    const motion::Program whole = milled(square);
    EXPECT_NEAR(whole.moves[1].start.tip_mm.x, 22, 1e-12);
    EXPECT_TRUE(warns_of(whole, 5, "moved aside by 8 mm, the radius that line 1 gives tool 8"));
    // An entry that is shorter than the radius, an arc and a corner that leave no room for it, also late.
    const struct {
        const char* moves;
        double feed_mm;
    } wear[] = {
        {"G41 D8\nG1 X5 Y0\nY60\nG40 X0\n", 70},
        {"G41 D8\nG1 X30\nG3 X32 Y2 I0 J2\nG1 Y60\nG40 X0\n", 30 + kPi + 58 + 32},
        {"G41 D8\nG1 X30\nY60\nX31\nY100\nX26\nY110\nX100\nG40 Y0\n", 30 + 60 + 1 + 40 + 5 + 10 + 74 + 110}};
    for (const auto& c : wear) {
        const motion::Program program = milled(c.moves);
        EXPECT_NEAR(feed_mm(program), c.feed_mm, 1e-9) << c.moves;
        EXPECT_TRUE(warns_of(program, 5, "D is taken to correct the wear of tool 8 alone")) << c.moves;
        // The next contour of that tool, which would fit, is the centre's too.
        EXPECT_NEAR(feed_mm(milled(std::string(c.moves) + "G0 X0 Y0\n" + square)), c.feed_mm + 30 + 240 + 30,
                    1e-9);
    }
    EXPECT_NEAR(feed_mm(milled(square, " WEAR COMP")), 30 + 240 + 30, 1e-9);
    // A tool of the job is the whole radius: it is refused where it does not fit.
    GcodeOptions job;
    job.tools = {{8, 16}};
    const auto refused = read_gcode("(T8 D=16.)\nG21 M3 F100\nG0 X0 Y0 Z0\nG41 D8\nG1 X5\nY60\n", job);
    EXPECT_FALSE(refused.has_value());
}

// Round a regular polygon: each side keeps its length and each corner adds its part of a full circle; inside,
// each side loses twice r tan of half the corner.
RC_GTEST_PROP(GcodeCompensation, RoundsAPolygonByTheClosedForm, ()) {
    const int corners = *rc::gen::inRange(3, 12);
    const double size = *rc::gen::inRange(2000, 9000) / 100.0;
    const double diameter = *rc::gen::inRange(10, 1000) / 100.0;
    const bool outside = *rc::gen::arbitrary<bool>();
    const auto corner = [&](int i) {
        const double angle = 2 * pi * i / corners;
        return "X" + short_decimal(size * std::cos(angle), 9) + " Y" +
               short_decimal(size * std::sin(angle), 9);
    };
    // Counter-clockwise: the left is inside. The way in is along the first side, from one side's length
    // before.
    const double side = 2 * size * std::sin(pi / corners);
    std::string text = "G21 M3 F100\nG0 Z0 ";
    const double x = size + (size - size * std::cos(2 * pi / corners)),
                 y = -size * std::sin(2 * pi / corners);
    text += "X" + short_decimal(x, 9) + " Y" + short_decimal(y, 9) + "\n";
    text += std::string(outside ? "G42.1" : "G41.1") + " D" + short_decimal(diameter, 9) + "\nG1 ";
    for (int i = 0; i <= corners; ++i) text += corner(i) + "\n";
    const Program program = program_of(text);
    const double r = diameter / 2, half = pi / corners;
    double length = 0;
    // The first move is the way in, the last side has no corner behind it.
    for (std::size_t i = 1; i < program.moves.size(); ++i) length += motion::path_length_mm(program.moves[i]);
    const double expected = outside ? corners * side + (corners - 1) * r * 2 * half
                                    : corners * side - (corners - 1) * 2 * r * std::tan(half);
    RC_ASSERT(std::abs(length - expected) < 1e-6);
}

}  // namespace
}  // namespace tribo::readers
