// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "readers/gcode/reader.hpp"
#include "readers/refusals.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

TEST(GcodeReader, RefusesWhatItDoesNotKnowWithItsPlace) {
    const std::string ready = "G21 M3 F100\nG0 X10 Y0 Z0\n";  // two lines
    const Refusal refusals[] = {
        {"", 0, 0, "no G-code"},
        {"\n\n(only a comment)\n%\n", 0, 0, "no G-code"},
        {std::string("G0 X1\0 Y2", 9), 1, 6, "byte 0x00"},
        {"G0 X1 Y\xE4 Z2", 1, 7, "no number after Y"},
        {"\xFF\xFEG\0", 1, 1, "byte 0xFF"},
        {"G21\nG0 X1 (a (b) Y2\n", 2, 10, "inside another comment"},
        {"G21\nG0 X1 )\n", 2, 7, "')' cannot start a word"},
        {"G21\n12 X1\n", 2, 1, "'1' cannot start a word"},
        {ready + "G1 @5 X1\n", 3, 7, "X or Y beside the polar words"},
        {ready + "G1 @5 @6\n", 3, 7, "'@' stands twice"},
        {ready + "G1 ^\n", 3, 4, "no number after ^"},
        {ready + "G0 X0\nG91 G1 @5 ^10\n", 4, 8, "begin at the zero of X and Y"},
        {ready + "G28 X0\n^10\n", 4, 1, "only the machine knows"},
        {"G21\nG0 X\n", 2, 4, "no number after X"},
        {"G21\nG0 X- Y1\n", 2, 4, "no number after X"},
        {"G21\nG0 X1.2.3\n", 2, 4, "malformed"},
        {"G21\nG0 X.\n", 2, 4, "malformed"},
        {"G21\nG0 X--1\n", 2, 4, "no number after X"},
        {"G21\nG0 X1E5\n", 2, 6, "like an exponent"},
        {"G21\n$J=X5 F100\n", 2, 1, "$J (jogging)"},
        {"G21\nG0 X" + std::string(65, '1') + "\n", 2, 4, "more than 64 digits"},
        {"G21\nG0 X1 X2\n", 2, 7, "X stands twice"},
        {"G21\nG0 X1 N5\n", 2, 7, "line number"},
        {"#1\n", 1, 1, "without '=' and a value"},
        {"#0=5\n", 1, 1, "from 1 to 5602"},
        {"#5603=5\n", 1, 1, "from 1 to 5602"},
        {"#1.5=5\n", 1, 1, "not a whole one"},
        {"#1=\n", 1, 4, "a number is missing"},
        {"#<>=1\n", 1, 2, "a name without letters"},
        {"#<a=1\n", 1, 2, "not closed"},
        {"#5420=1\n", 1, 1, "#5420 shows the state of the control"},
        {"#<_line>=1\n", 1, 1, "#<_line> shows the state"},
        {"#5221=1\n", 1, 1, "#5221 holds an offset"},
        {"G21\nG0 X#<depth>\n", 2, 5, "#<depth> has no value"},
        {"G21\nG0 X#5061\n", 2, 5, "a probe or an input has measured"},
        {"G21\nG0 X[#5420+1]\n", 2, 6, "X, which is not known here"},
        {"G21\nG1 X[1+2\n", 2, 5, "'[' is not closed"},
        {"G21\nG1 X[1 $ 2]\n", 2, 8, "'$' is neither an operator nor the end"},
        {"G21\nG1 X[1 +]\n", 2, 9, "a number is missing"},
        {"G21\nG1 X[1/0]\n", 2, 7, "division by zero"},
        {"G21\nG1 X[5 MOD 0]\n", 2, 8, "division by zero"},
        {"G21\nG1 X[-8 ** 0.5]\n", 2, 9, "power without a real value"},
        {"G21\nG1 XSQRT[-1]\n", 2, 5, "no value there: SQRT"},
        {"G21\nG1 XACOS[2]\n", 2, 5, "no value there: ACOS"},
        {"G21\nG1 XLN[0]\n", 2, 5, "no value there: LN"},
        {"G21\nG1 XATAN[1]\n", 2, 12, "ATAN has one argument"},
        {"G21\nG1 X[FOO[1]]\n", 2, 6, "neither a number nor a function"},
        {"G21\nG1 X[EXISTS[1]]\n", 2, 12, "EXISTS asks for a parameter"},
        {"G21\n[1+2]\n", 2, 1, "without a letter or parameter"},
        {"G21\nG1 X" + std::string(70, '[') + "1\n", 2, 65, "nested more than 60 deep"},
        {"O100 sub\n", 1, 1, "o100 sub is never closed"},
        {"O100 if [1]\n", 1, 1, "o100 if is never closed"},
        {"O100 if\nO100 endif\n", 1, 8, "if without its [expression]"},
        {"O100 else\n", 1, 1, "without its if"},
        {"O100 endwhile\n", 1, 1, "without the start of its loop"},
        {"O100 repeat [2]\nO101 break\nO100 endrepeat\n", 2, 1, "stands in no loop of that label"},
        {"O100 repeat [1e3]\nO100 endrepeat\n", 1, 15, "neither an operator nor the end"},
        {"O100 endsub\n", 1, 1, "outside of that subroutine"},
        {"O100 jump\n", 1, 6, "'jump' is nothing that an O-word does"},
        {"O100 sub\nO100 endsub\nO100 call 5\n", 3, 11, "nothing but a comment"},
        {"O<name> call\n", 1, 1, "this file has no o<name> sub"},
        {"O[1+1] while [1]\n", 1, 1, "only a call may compute"},
        {"(a) O1 sub\nO1 endsub\n", 1, 5, "not stand at the start of its line"},
        {"#1=2 O1 sub\nO1 endsub\n", 1, 6, "an O-word stands inside the block"},
        {"O sub\n", 1, 1, "O without a number or <name>"},
        {"O1 sub\nO1 call\nO1 endsub\nO1 call\n", 2, 1, "more than 100 deep"},
        {"G21\nM98\n", 2, 1, "the number of a program as P"},
        {"G21\nM98 P1000\n", 2, 5, "M98 calls O1000, which this file does not have"},
        {"M98 P7 L-1\nM30\nO7\nM99\n", 1, 8, "no number of times"},
        {"M98 P7\nM30\nO7\nG21\n", 4, 1, "before M99 has ended O7"},
        {"M98 P7\nM30\nO7\nG21\nO8\nM99\n", 5, 1, "another program starts here"},
        {"M98 P7\nM30\nO7\nM99 P10\n", 4, 1, "no line N10"},
        {"M98 P7\nM30\nO7\nM99 P1.5\n", 4, 5, "not the number of a line"},
        {"M97\n", 1, 1, "M97 needs the number of a line"},
        {"M97 P5\n", 1, 5, "M97 calls N5, which this program lacks"},
        {"G65\n", 1, 1, "G65 needs the number of a program"},
        {"G65 P9 X1\n", 1, 5, "G65 calls O9, which this file does not have"},
        {"G1 G65 P9\n", 1, 1, "G65 is not the first word"},
        {"G65 P9 N5 X1\n", 1, 8, "line number"},
        {"O1 (a)\nO2 (b)\n", 2, 1, "second program"},
        {"TRAORI\n", 1, 1, "'TRAORI' is not a letter with a number"},
        {"G1 X=5\n", 1, 4, "'X=' is a word of another dialect"},
        {"G21 G20\n", 1, 5, "G20 contradicts G21"},
        {"G0 G1 X1\n", 1, 4, "G1 contradicts G0"},
        {"M3 M5\n", 1, 4, "M5 contradicts M3"},
        {"G999\n", 1, 1, "G999 is not known"},
        {"G1.55\n", 1, 1, "G1.55 is not known"},
        {"G-1\n", 1, 1, "G-1 is not known"},
        {"M1.55\n", 1, 1, "M1.55 is not known"},
        {"M-1\n", 1, 1, "M-1 is not known"},
        {"M73\n", 1, 1, "M73 (restoring the modes that M70 has saved) is not read yet"},
        {"G68.2 X0 P5\n", 1, 10, "is read with P0 to P4"},
        {"G68.2 X0 P2\n", 1, 1, "G68.2 P2 without Q1 to Q3"},
        {"G68.2 P3 Q3\n", 1, 10, "G68.2 P3 without Q1 to Q2"},
        {"G68.2 P2 Q1\nG68.2 P2 Q2 X5\nG68.2 P2 Q3 X9\n", 3, 1, "lie on one line"},
        {"G68.2 P1 Q122 X0\n", 1, 10, "Q is no order of the axes"},
        {"G51 X0 Y0 P2\nG68.2 X0 I10\n", 2, 1, "a tilted plane in coordinates that are turned"},
        {"G68.2 X0 I10\nG55\n", 2, 1, "another work system in a tilted plane"},
        {"G70 I5 L8\n", 1, 1, "G70 (a pattern of holes) without a cycle"},
        {"G81 Z-1 R1 F9 L0\nG72 J5 L8\n", 2, 1, "G72 without its size I"},
        {"G71 U1 R2\n", 1, 1, "G71 (a cycle of a lathe) is not read yet"},
        {"G66.1 P9 X1\n", 1, 1, "G66.1 (macro calls at every block) is not read yet"},
        {"G66 X1\n", 1, 1, "G66 needs the number of a program"},
        {"G7.1 X10\n", 1, 1, "G7.1 without the radius of its cylinder"},
        {"G12 K5\n", 1, 1, "G12 without a radius I"},
        {ready + "G12 I5 X9\n", 3, 1, "G12 begins at another place"},
        {ready + "G1 X9 ,R2\nZ3\n", 4, 1, "the corner of line 3 is not followed by a feed move in its plane"},
        {ready + "G1 X9 ,R2\nG0 Y9\n", 4, 1, "the corner of line 3 is not followed"},
        {ready + "G1 X9 ,R2\n", 3, 1, "the corner of line 3 is not followed"},
        {ready + "G1 X9 Z9 ,R2\nY9\n", 3, 1, "a corner at the end of a move that leaves the plane"},
        {ready + "G1 X9 ,R99\nY9\n", 3, 1, "the corner of 99 mm does not fit"},
        {ready + "G51 X0 Y0 Z0 I2 J1 K1\nG1 X9 ,R2\nY9\n", 4, 8, "a corner is scaled differently"},
        {ready + "G0 X9 ,R2\n", 3, 8, "a corner (,R or ,C) without a feed move"},
        {ready + "G1 X9 ,X2\n", 3, 8, "a comma without R or C behind it"},
        {ready + "G1 X9 G36\nY9\n", 3, 7, "G36 without the size R"},
        {"T1 T2\n", 1, 4, "T stands twice in the block"},
        {"G150 P1 X1 Q2\n", 1, 1, "G150 lacks P, Z, Q, or one of I and J"},
        {"G96 S100\n", 1, 1, "G96 (constant surface speed) is not read yet"},
        {"G33 Z1 K1\n", 1, 1, "G33 (moves synchronised with the spindle) is not read yet"},
        {"G68 X0 Y0\n", 1, 1, "G68 without an angle R"},
        {"G68 X0 Y0 K1\n", 1, 1, "G68 in space without"},
        {"G51 X0\n", 1, 1, "G51 without its scale"},
        {"G51 P0\n", 1, 5, "the scale is smaller"},
        {"G51.1\n", 1, 1, "without the place of its mirror"},
        {ready + "G51 I2 J3\nG2 X20 Y0 I5\n", 4, 4, "scaled differently along the axes"},
        {ready + "G81 G80 Z-1 R1\n", 3, 5, "G80 contradicts G81"},
        {ready + "G1 X1 , 5\n", 3, 8, "a comma without R or C"},
        {"G21 M3\nG0 X0 Y0 Z0\nG1 X1\n", 3, 4, "before any F"},
        {"G21 M3\nG0 X0 Y0 Z0\nG1 X1 F0\n", 3, 7, "feed rate 0"},
        {"G21\nG1 X1 F-5\n", 2, 7, "feed of -5 mm/min is out of range"},
        {"G21\nS-5\n", 2, 1, "spindle speed of -5 rpm is out of range"},
        {"G21\nT-1 M6\n", 2, 1, "tool number of -1 is out of range"},
        {"G21\nT0.5 M6\n", 2, 1, "tool number of 0.5 is out of range"},
        {"G54.1\n", 1, 1, "without a work system P from 1 to 300"},
        {"G54 P301\n", 1, 5, "without a work system P from 1 to 300"},
        {ready + "G93 G1 X1\n", 3, 8, "G93 without its own F"},
        {ready + "G93 G1 X1 F2\nX2\n", 4, 1, "G93 without its own F"},
        {ready + "G93\nG94\nG1 X1\n", 5, 4, "before any F"},
        {ready + "G95 G1 X1 F0.1\n", 3, 11, "spindle speed unknown"},
        {ready + "G3 X0 Y10\n", 3, 4, "without centre or radius"},
        {ready + "G3 X0 Y11 I-10\n", 3, 11, "10 mm at its start and 11 mm at its end"},
        {ready + "G3 X0 Y10 R5\n", 3, 11, "radius 5 mm cannot reach the end, which lies 14.1421 mm"},
        {ready + "G3 X10 Y0 R5\n", 3, 11, "ends where it starts"},
        {ready + "G3 X0 Y10 R10 I-5\n", 3, 11, "a radius and a centre"},
        {ready + "G3 X0 Y10 I-10 K1\n", 3, 16, "no use for K"},
        {ready + "G3 X0 I0 J0\n", 3, 7, "centre at its start"},
        {ready + "G90.1 G3 X0 Y10 I0\n", 3, 17, "needs both I and J"},
        {ready + "G3 I-10 P0\n", 3, 9, "number of turns"},
        {ready + "G1 X5 I2\n", 3, 7, "I without an arc"},
        {ready + "G1 X5 R2\n", 3, 7, "R without an arc"},
        {ready + "G1 X5 Y1 U2 V1\n", 3, 10, "hot wire"},
        {ready + "G2 X5 I-2.5 W1\n", 3, 13, "axis of an arc"},
        {ready + "G1 X2000000\n", 3, 4, "X: the coordinate of 2000000 mm is out of range"},
        {ready + "G3 I9999999999\n", 3, 4, "I: the coordinate of 9999999999 mm is out of range"},
        {ready + "G4 P-1\n", 3, 4, "dwell of -1 s is out of range"},
        {ready + "G4 P1 X5\n", 3, 7, "X without a code"},
        {ready + "G10 L50 P1 X0\n", 3, 5, "of G10 only"},
        {"G21\nG0 X1\nG10 L20 P2 Y0\n", 3, 1, "Y is not known"},
        {ready + "G10 L20 P1 R5\n", 3, 12, "does not turn work systems"},
        {"G21\nG0 X1\nG10 L2 P1 R5\n", 3, 11, "only one of X and Y is known"},
        {ready + "G10 L1 X0\n", 3, 1, "the number of a tool"},
        {ready + "G52\n", 3, 1, "G52 without coordinates"},
        {ready + "G10 L2 P10 X0\n", 3, 8, "work system P"},
        {ready + "G10 L2 P1 R500\n", 3, 11, "more than 360 degrees"},
        {ready + "G92\n", 3, 1, "without coordinates"},
        {ready + "G2 G92 X5\n", 3, 4, "both claim"},
        {ready + "G91 G53 G0 X5\n", 3, 5, "G91"},
        {ready + "G28\nG5 X5 I1 J1 P1 Q1\n", 4, 4, "unknown X, which line 3"},
        {ready + "G81 X1 Z-2\n", 3, 1, "G81 without R"},
        {ready + "G81 X1 R2\n", 3, 1, "G81 without Z"},
        {ready + "G18 G81 X1 R2\n", 3, 5, "G81 without Y"},
        {ready + "G81 X1 Z3 R2\n", 3, 1, "bottom lies above its retract level"},
        {ready + "G83 X1 Z-3 R2 Q0.000001\n", 3, 1, "more than 100000 pecks"},
        {ready + "G82 X1 Z-3 R2 P-1\n", 3, 15, "the dwell of -1 s is out of range"},
        {ready + "G81 X1 Z-3 R2 L-1\n", 3, 15, "the cycle's repeats"},
        {ready + "G76 P1 Z-3 I1 J1 K1\n", 3, 1, "a thread on a lathe"},
        {ready + "G87 X1 Z3 R-2\n", 3, 1, "back boring"},
        {ready + "G93 G81 X1 Z-3 R2 F1\n", 3, 5, "has no feed"},
        {ready + "G81 X1 Z-3 R2\nG0 X0\nR3\n", 5, 1, "R without an arc"},
        {ready + "G5 X5 I1 J1\n", 3, 1, "without its second control point"},
        {ready + "G5 X5 P1 Q1\n", 3, 1, "without its first control point"},
        {ready + "G5 X5 I1 J1 P1 Q1 Z4\n", 3, 19, "no motion along Z"},
        {ready + "G18 G5 X5 I1 J1 P1 Q1\n", 3, 5, "in the XY plane only"},
        {ready + "G5.1 X5\n", 3, 1, "without its control point"},
        {ready + "G5.2 X1\n", 3, 6, "without both X and Y"},
        {ready + "G5.2 X1 Y1 P0\n", 3, 12, "the weight of a pose of 0 is out of range"},
        {ready + "G5.2 X1 Y1 P1 L11\n", 3, 15, "the order of a B-spline"},
        {ready + "G5.2 X1 Y1 P1 L3\nG5.3\n", 3, 1, "order 3 has only 2 control points"},
        {ready + "G5.2 X1 Y1 P1\nX2 Y2\nG1 X5\n", 5, 1, "begun in line 3 is not ended"},
        {ready + "G5.2 X1 Y1 P1\nX2 Y2\n", 3, 1, "is never ended"},
        {ready + "G91 G5.2 X1 Y1\n", 3, 5, "increments (G91)"},
        {ready + "G93 G5.2 X1 Y1 F2\n", 3, 5, "has no feed"},
        {ready + "G5.3\n", 3, 1, "nothing has begun"},
        {ready + "G6.2 P3 X10 Y0\n", 3, 1, "without its knot"},
        {ready + "G6.2 P3 K0 X11 Y0\n", 3, 1, "1 mm from the tip"},
        {ready + "G6.2 P3 K1 X10\nK0 X5\n", 4, 1, "do not ascend"},
        {ready + "G6.2 P3 K0 X10\nK0 X5\nK0 X3\nK1\nG1 X0\n", 3, 1, "has 4 knots and not 6"},
        {ready + "G6.2 P3 K0 X10\nK1 X5\nK2 X3\nK3\nK4\nK5\nG1 X0\n", 3, 1, "do not hold its ends"},
        {ready + "G41.1\n", 3, 1, "without the cutter's diameter"},
        {ready + "G41.1 D-2\n", 3, 7, "of -2 mm is out of range"},
        {ready + "G42 D1.5\n", 3, 5, "not the number of a tool"},
        {ready + "G41.1 D4\nG1 X11\n", 4, 1, "not longer than the cutter's radius of 2 mm"},
        {ready + "G41.1 D4\nG1 X20\nG3 X22 Y2 J2\n", 5, 1, "radius 2 mm is not larger than the cutter's"},
        {ready + "G41.1 D4\nG1 X20\nY1\n", 5, 1, "without gouging line 4"},
        {ready + "G41.1 D4\nG1 X20\nG41.1 D5\n", 5, 1, "G41.1 does not go with the cutter compensation"},
        {ready + "G41.1 D4\nG1 X20\nD5 X30\n", 5, 1, "D changes the cutter compensation"},
        {ready + "G41.1 D4\nG68 X0 Y0 R10\n", 4, 1, "while cutter compensation is on"},
        {ready + "G41.1 D4\nG18\n", 4, 1, "G18 does not go with the cutter compensation that line 3"},
        {ready + "G41.1 D4\nG20\n", 4, 1, "G20 does not go"},
        {ready + "G41.1 D4\nG55\n", 4, 1, "G55 does not go"},
        {ready + "G41.1 D4\nG28\n", 4, 1, "G28 does not go"},
        {ready + "G41.1 D4\nG92 X0\n", 4, 1, "G92 does not go"},
        {ready + "G41.1 D4\nG81 X1 Z-1 R1\n", 4, 1, "G81 does not go"},
        {ready + "G41.1 D4\nG5.1 X1 I1 J1\n", 4, 1, "G5.1 does not go"},
        {ready + "G41.1 D4\nT1 M6\n", 4, 4, "M6 does not go"},
        {ready + "G41.1 D4\nG1 X20\nG40 G2 X30 I5\n", 5, 1, "a curve cannot lead out"},
    };
    expect_refused(refusals, [](const std::string& text, const char* name) {
        GcodeOptions options;
        options.source_name = name;
        return read_gcode(text, options);
    });
}

TEST(GcodeReader, RefusesLoopsWithoutEndAndNamesALineOfThem) {
    GcodeOptions options;
    options.max_steps = 1000;
    for (const char* text : {"#1=0\nO1 while [1]\n#1=[#1+1]\nO1 endwhile\n", "O1 do\n\n\nO1 while [1 EQ 1]\n",
                             "O1 repeat [100000]\n\nO1 endrepeat\n"}) {
        const auto program = read_gcode(text, options);
        ASSERT_FALSE(program.has_value()) << text;
        EXPECT_NE(program.error().cause.find("does not seem to end"), std::string::npos);
        EXPECT_GE(program.error().line, 1);
        EXPECT_LE(program.error().line, 4);
    }
}

// Work that no count of blocks shows: long lines, chains of elseif, blocks that are skipped.
TEST(GcodeReader, RefusesLoopsByTheCharactersThatTheyRun) {
    std::string branches, skipped, comment;
    for (int i = 0; i < 50'000; ++i) {
        branches += "o2 elseif [0]\n";
        skipped += "/ G1 X1\n";
    }
    for (int i = 0; i < 50; ++i) comment += "(" + std::string(4000, '-') + ")\n";
    for (const std::string& body : {"o2 if [0]\n" + branches + "o2 endif\n", skipped, comment}) {
        const auto program = read_gcode("o1 while [1]\n" + body + "o1 endwhile\n");
        ASSERT_FALSE(program.has_value());
        EXPECT_NE(program.error().cause.find("50000000 characters have run without a move"),
                  std::string::npos)
            << program.error().text();
    }
    // The same blocks once are a program.
    EXPECT_TRUE(read_gcode("G21 M3 F100\nG0 X0 Y0 Z0\nG1 X1\n" + skipped + comment).has_value());
}

TEST(GcodeReader, RefusesLoopsByTheClock) {
    GcodeOptions options;
    double now_s = 100;
    options.clock_s = [&] { return now_s += 0.5; };
    const std::string loop = "G21 M3 F100\nG0 X0 Y0 Z0\no1 while [1]\nG1 X1\nX2\no1 endwhile\n";
    const auto program = read_gcode(loop, options);
    ASSERT_FALSE(program.has_value());
    EXPECT_NE(program.error().cause.find("have run for 3 s"), std::string::npos) << program.error().text();
    EXPECT_GE(program.error().line, 3);
    EXPECT_FALSE(program.error().remedy.empty());
    // A program without loops may take its time.
    std::string straight = "G21 M3 F100\nG0 X0 Y0 Z0\nG1\n";
    for (int i = 0; i < 20'000; ++i) straight += i % 2 != 0 ? "X1\n" : "X2\n";
    const auto read = read_gcode(straight, options);
    ASSERT_TRUE(read.has_value()) << read.error().text();
    EXPECT_EQ(read->moves.size(), 20'000U);
}

TEST(GcodeReader, RefusesABlockThatNoControlTakes) {
    const std::string longest = "G1 X1 (" + std::string(kLongestBlock - 8, '-') + ")";
    const auto read = read_gcode("G21 M3 F100\nG0 X0 Y0 Z0\n" + longest + "\n");
    EXPECT_TRUE(read.has_value()) << read.error().text();
    const auto refused = read_gcode("G21 M3 F100\nG0 X0 Y0 Z0\n" + longest + " \n");
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().line, 3);
    EXPECT_NE(refused.error().cause.find("4097 characters, more than 4096"), std::string::npos);
}

// A spline a kilometre wide is cut into thousands of pieces.
TEST(GcodeReader, RefusesMoreMovesThanAllowedWithinABlock) {
    GcodeOptions options;
    options.max_moves = 100;
    const auto program =
        read_gcode("G21 M3 F100\nG0 X0 Y0 Z0\nG5 I900000 J0 P0 Q900000 X900000 Y900000\n", options);
    ASSERT_FALSE(program.has_value());
    EXPECT_EQ(program.error().line, 3);
    EXPECT_NE(program.error().cause.find("more than 100 moves"), std::string::npos);
}

TEST(GcodeReader, RefusesMoreMovesThanAllowed) {
    GcodeOptions options;
    options.max_moves = 2;
    const auto program = read_gcode("G21 M3 F100\nG0 X0 Y0 Z0\nG1 X1\nX2\nX3\n", options);
    ASSERT_FALSE(program.has_value());
    EXPECT_EQ(program.error().line, 5);
}

// Statements of Fanuc macro programs.
TEST(GcodeReader, RefusesMacroStatementsThatItCannotRun) {
    const Refusal refusals[] = {
        {"GOTO 10\n", 1, 1, "no line N10 to go to"},
        {"GOTO 1.5\n", 1, 1, "not a whole one"},
        {"IF #1 EQ 2 GOTO 10\n", 1, 1, "without its [condition]"},
        {"IF [1 EQ 1] G0\n", 1, 13, "IF without GOTO or THEN"},
        {"WHILE [1 EQ 1]\n", 1, 15, "WHILE without DO"},
        {"WHILE [1 EQ 2] DO1\nG0 X1\n", 1, 1, "DO1 has no END1"},
        {"G0 X1\nEND2\n", 2, 1, "END2 without its DO"},
        {"WHILE [1 EQ 1] DO128\nEND128\n", 1, 1, "not one from 1 to 127"},
        {"GOTO 10 G0 X1\n", 1, 9, "nothing but a comment"},
        {"IF [1 EQ 2] GOTO 10 (A) #5=3\n", 1, 25, "nothing but a comment"},
        {"G0 X#5021\n", 1, 5, "a state of the control that nobody knows"},
        {"G0 X#5430\n", 1, 5, "a state of the control that nobody knows"},
        {"G43 G49 H1\n", 1, 5, "G49 contradicts G43"},
        {"G0 G81 X1 Z-1 R1\n", 1, 4, "G81 contradicts G0"},
        {"#100000=1\n", 1, 1, "from 1 to 99999"},
        {"#0=1\n", 1, 1, "#0 cannot be assigned"},
        {"G65 P9 X1\nM30\nO8\nM99\n", 1, 5, "G65 calls O9"},
        {"G65 P8 O1\nM30\nO8\nM99\n", 1, 8, "an O-word stands inside"},
    };
    expect_refused(refusals, [](const std::string& text, const char* name) {
        GcodeOptions options;
        options.source_name = name;
        options.dialect = GcodeDialect::fanuc;
        return read_gcode(text, options);
    });
}

TEST(GcodeReader, GivesAllRefusalsAtOnce) {
    std::vector<Error> refusals;
    GcodeOptions options;
    options.source_name = "part.nc";
    options.refusals = &refusals;
    const auto program = read_gcode(
        "G21 M3 F100\nG0 X0 Y0 Z5\nG112 I5\nG1 Z-1\nX5 Y1 U2 V1\nG112 I6\nG999\nG0 X1 $ Y2\nX9\n", options);
    ASSERT_FALSE(program.has_value());
    ASSERT_EQ(refusals.size(), 4U);
    EXPECT_EQ(program.error().text(), refusals[0].text());
    const int lines[] = {3, 5, 7, 8};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(refusals[i].line, lines[i]) << refusals[i].text();
        EXPECT_EQ(refusals[i].file, "part.nc");
        EXPECT_FALSE(refusals[i].remedy.empty());
    }

    // A text that ends inside a subprogram ends the reading too.
    refusals.clear();
    EXPECT_FALSE(read_gcode("G21\nM98 P7\nM30\nO7\nG112 I5\n", options).has_value());
    ASSERT_EQ(refusals.size(), 2U);
    EXPECT_NE(refusals[1].text().find("the text ends before M99"), std::string::npos) << refusals[1].text();

    // No more than are worth reading; a program without refusals leaves none.
    refusals.clear();
    std::string many = "G21\n";
    for (int i = 0; i < 50; ++i) many += "G" + std::to_string(600 + i) + "\n";
    EXPECT_FALSE(read_gcode(many, options).has_value());
    EXPECT_EQ(refusals.size(), kMostRefusals);
    refusals.clear();
    EXPECT_TRUE(read_gcode("G21 G0 X0 Y0 Z0\n", options).has_value());
    EXPECT_TRUE(refusals.empty());
}

}  // namespace
}  // namespace tribo::readers
