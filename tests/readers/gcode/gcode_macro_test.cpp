// SPDX-License-Identifier: MIT
// Macro programs of Fanuc and Haas controls: variables, branches, loops, jumps, calls.
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "readers/gcode/gcode_text.hpp"

namespace tribo::readers {
namespace {

motion::Program macro(const std::string& text) {
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    return program_of(text, options);
}

double feed_of(const std::string& text) {
    return feed_mm(macro("G21 M3 F100\nG0 X0 Y0 Z0\nG1\n" + text));
}
double end_x(const std::string& text) {
    const motion::Program program = macro("G21 M3 F100\nG0 X0 Y0 Z0\nG1\n" + text);
    return program.moves.back().end.tip_mm.x;
}

TEST(GcodeMacro, RunsBranchesLoopsAndJumps) {
    EXPECT_DOUBLE_EQ(end_x("#1=1\nWHILE[#1 LE 4] DO1\nX[#1*10]\n#1=#1+1\nEND1\nX100\n"), 100);
    EXPECT_DOUBLE_EQ(feed_of("#1=1\nWHILE[#1 LE 4]DO1\nX[#1*10]\n#1=#1+1\nEND1\n"), 40);
    EXPECT_DOUBLE_EQ(feed_of("#1=0\nN10 #1=#1+1\nX#1\nIF [#1 LT 5] GOTO 10\nX9\n"), 9);
    EXPECT_DOUBLE_EQ(feed_of("IF[1 EQ 1]GOTO20\nX50\nN20 X5\n"), 5);
    EXPECT_DOUBLE_EQ(feed_of("IF[1 EQ 2]GOTO20\nX50\nN20 X55\n"), 55);
    EXPECT_DOUBLE_EQ(feed_of("IF[1 NE 2] THEN #5=7\nIF [1 EQ 2] THEN #5=9\nX#5\n"), 7);
    EXPECT_DOUBLE_EQ(feed_of("#1=30\nGOTO#1\nX50\nN30 X5\n"), 5);
    // Two loops inside each other: 3 x 2 steps of 1 mm.
    EXPECT_DOUBLE_EQ(feed_of("G91\n#1=0\nWHILE[#1LT3]DO1\n#2=0\nWHILE[#2LT2]DO2\nX1\n#2=#2+1\nEND2\n"
                             "#1=#1+1\nEND1\n"),
                     6);
    // A jump out of a loop, which is entered again.
    EXPECT_DOUBLE_EQ(feed_of("G91\n#3=0\nN5 #1=0\nWHILE[#1LT10]DO1\nX1\n#1=#1+1\nIF[#1EQ2]GOTO8\nEND1\n"
                             "N8 #3=#3+1\nIF[#3LT3]GOTO5\n"),
                     6);
    // Statements behind DO on its line, and one behind another: 3 steps, the last of half a mm.
    EXPECT_DOUBLE_EQ(feed_of("G91\n#1=2.5\nWHILE[#1GT0]DO1 #2=1 IF[#1LT1] THEN #2=#1\nX#2\n#1=#1-1\nEND1\n"),
                     2.5);
    EXPECT_DOUBLE_EQ(feed_of("#1=1 IF[#1EQ1]GOTO20\nX50\nN20 X5\n"), 5);
    EXPECT_DOUBLE_EQ(feed_of("WHILE[1EQ2]DO1 X9\nX8\nEND1\nX5\n"), 5);
    // Comments within brackets, a bare point, the common variables of Haas, the tool in the spindle.
    EXPECT_DOUBLE_EQ(feed_of("#6=2\nX[#6 (step) + 3 (more)]\n"), 5);
    EXPECT_DOUBLE_EQ(feed_of("X5 Y.\n"), 5);
    EXPECT_DOUBLE_EQ(feed_of("#10002=#3020-#10000\nX[5+#10002]\n"), 5);
    EXPECT_DOUBLE_EQ(feed_of("T5 M6\nX#3026\n"), 5);
    // A line of the same number in another program is another line.
    EXPECT_DOUBLE_EQ(feed_of("GOTO10\nX50\nN10 M98 P2\nM30\nO2\nGOTO10\nX60\nN10 X3\nM99\n"), 3);
}

TEST(GcodeMacro, KnowsVacantVariables) {
    EXPECT_DOUBLE_EQ(end_x("IF[#1 EQ #0] THEN #1=8\nX#1\n"), 8);
    EXPECT_DOUBLE_EQ(end_x("#1=0\nIF[#1 EQ #0] THEN #1=8\nX[#1+2]\n"), 2);
    EXPECT_DOUBLE_EQ(end_x("IF[#1 EQ 0] THEN #2=8\nX[#1+5]\n"), 5);  // vacant is not 0
    EXPECT_DOUBLE_EQ(feed_of("X5 Y#9\n"), 5);                        // the word is left out
    EXPECT_DOUBLE_EQ(end_x("#1=5\n#1=#0\nIF[#1 EQ #0] THEN #2=6\nX#2\n"), 6);
    EXPECT_TRUE(warns_of(macro("G21\nG0 X#9 Y0\n"), 2, "a word with it is left out"));
}

TEST(GcodeMacro, PassesArguments) {
    const std::string sub = "M30\nO9\nX#24 Y#25 Z#26\nM99\n";
    EXPECT_NEAR(feed_of("G65 P9 X3 Y4 Z12\n" + sub), 13, 1e-12);
    EXPECT_NEAR(feed_of("G65 P9 X3\n" + sub), 3, 1e-12);  // the others are vacant
    EXPECT_NEAR(feed_of("G65P9X3.E4.Y4.\n" + sub), 5, 1e-12);
    // All letters, and a second set of I J K.
    EXPECT_DOUBLE_EQ(
        end_x(
            "G65 P9 A1 B2 C3 D7 E8 F9 H11 M13 Q17 R18 S19 T20 U21 V22 W23 X24 Y25 Z26 I4 J5 K6 I100\n"
            "M30\nO9\nX[#1+#2+#3+#4+#5+#6+#8+#9+#11+#13+#17+#18+#19+#20+#21+#22+#23+#24+#25+#26+#7]\nM99\n"),
        1 + 2 + 3 + 4 + 5 + 6 + 8 + 9 + 11 + 13 + 17 + 18 + 19 + 20 + 21 + 22 + 23 + 24 + 25 + 26 + 100);
    // Variables of a call are its own; common ones are not. M98 has no level.
    EXPECT_DOUBLE_EQ(end_x("#1=5 #100=1\nG65 P9 A77\nX[#1+#100]\nM30\nO9\n#100=#1\nM99\n"), 82);
    EXPECT_DOUBLE_EQ(end_x("#1=5\nM98 P9\nX#1\nM30\nO9\n#1=#1+1\nM99\n"), 6);
    EXPECT_DOUBLE_EQ(feed_of("G91\nG65 P9 L3 A2\nM30\nO9\nX#1\nM99\n"), 6);
}

TEST(GcodeMacro, CallsLinesAndRepeats) {
    EXPECT_DOUBLE_EQ(feed_of("G91\nM97 P100 L3\nM30\nN100 X2\nM99\n"), 6);
    EXPECT_DOUBLE_EQ(feed_of("G91\nM98 P30009\nM30\nO0009\nX2\nM99\n"), 6);  // three times O9
    EXPECT_DOUBLE_EQ(feed_of("M98 P9\nX50\nN7 X5\nM30\nO9\nM99 P7\n"), 5);
    EXPECT_DOUBLE_EQ(feed_of("M98 P100\nM30\n:0100\nX5\nM99\n"), 5);
    // Q: from a line of this program on, or of the called one.
    EXPECT_DOUBLE_EQ(feed_of("G91\nM98 Q100 L3\nM30\nN100 X2\nM99\n"), 6);
    EXPECT_DOUBLE_EQ(feed_of("G91\nM98 P9 H20 L2\nM30\nN20 X50\nO9\nX60\nN20 X3\nM99\n"), 6);
    EXPECT_DOUBLE_EQ(feed_of("G91\nM98 P9 Q20 L2\nM30\nN20 X50\nO9\nX60\nN20 X3\nM99\n"), 6);
}

// As the manuals of Fanuc and Haas say, and LinuxCNC does not.
TEST(GcodeMacro, ComputesAsFanucControlsDo) {
    const std::pair<const char*, double> cases[] = {
        {"12 AND 10", 8},
        {"12 OR 3", 15},
        {"12 XOR 10", 6},
        {"[13 AND 4] EQ 4", 1},
        {"[1 LT 2] AND [3 LT 4]", 1},
        {"5 AND 3 * 2", 2},  // AND has the rank of *, OR and XOR that of +
        {"1 + 2 AND 4", 1},
        {"1 OR 1 + 1", 2},
        {"1 XOR 1 + 1", 1},
        {"[6 AND 2 EQ 2]", 1},
        {"1 EQ 1 AND 2 EQ 2", 1},  // two comparisons: AND joins them
        {"[[1 EQ 1 AND 2 EQ 3] + 5 AND 3 * 2]", 2},
        {"-7 MOD 3", -1},
        {"27 MOD 20", 7},
        {"7.9 MOD 2.9", 2},
        {"FIX[-1.2]", -1},
        {"FUP[-1.2]", -2},
        {"ATAN[-1]/[-1]", 225},
        {"ATAN[1]/[-1]", 135},
        {"ROUND[1.7]", 2},
    };
    for (const auto& [formula, value] : cases)
        EXPECT_NEAR(end_x(std::string("#1=") + formula + "\nX#1\n"), value, 1e-9) << formula;
    // In a word ROUND rounds to the least increment.
    EXPECT_NEAR(end_x("#1=1.2345\n#2=2.3456\nX[ROUND[#1]+ROUND[#2]]\n"), 1.235 + 2.346, 1e-9);
    EXPECT_NEAR(end_x("#1=1.2345\nG20 X0\nX[ROUND[#1*1.00001]]\n"), 25.4 * 1.2345, 1e-9);
}

// Custom macro B: two letters of a word are enough.
TEST(GcodeMacro, KnowsWordsByTheirFirstTwoLetters) {
    EXPECT_DOUBLE_EQ(feed_of("G91\n#1=0\nWH[#1LT3]DO1\nX1\n#1=#1+1\nEN1\n"), 3);
    EXPECT_DOUBLE_EQ(feed_of("IF[1EQ1]GO20\nX50\nN20 X5\n"), 5);
    EXPECT_DOUBLE_EQ(feed_of("GO 20\nX50\nN20 X5\n"), 5);
    EXPECT_DOUBLE_EQ(end_x("#1=SQ[16]+RO[2.6]+FI[1.7]+FU[1.2]+AB[-3]\nX#1\n"), 4 + 3 + 1 + 2 + 3);
    EXPECT_NEAR(end_x("X[10*[SI[30]+CO[60]+TA[45]]]\n"), 20, 1e-9);
    EXPECT_NEAR(end_x("X[AS[0.5]+AC[0.5]+AT[1]/[1]]\n"), 30 + 60 + 45, 1e-9);
    // In other dialects they are no words.
    EXPECT_FALSE(read_gcode("G21 G90\nG0 X[SQ[16]]\n").has_value());
}

TEST(GcodeMacro, ComputesAsAFanucControl) {
    EXPECT_DOUBLE_EQ(end_x("X[FIX[-1.5]+10]\n"), 9);  // towards zero
    EXPECT_DOUBLE_EQ(end_x("X[FUP[-1.5]+10]\n"), 8);
    EXPECT_NEAR(end_x("X[ATAN[1]/[1]]\n"), 45, 1e-12);
    EXPECT_NEAR(end_x("X[ATAN[1,1]]\n"), 45, 1e-12);
    EXPECT_NEAR(end_x("X[ATAN[1]]\n"), 45, 1e-12);
    EXPECT_NEAR(end_x("X[POW[2,5]]\n"), 32, 1e-12);
    EXPECT_DOUBLE_EQ(end_x("#1=2+3*4\nX#1\n"), 14);
    EXPECT_DOUBLE_EQ(end_x("X7\n#1=#5041\nX[#1+1]\n"), 8);
    EXPECT_DOUBLE_EQ(end_x("G91\n#1=#4003\nG90\nX#1\n"), 91);
    EXPECT_DOUBLE_EQ(end_x("#5221=100\nX1\n"), 101);
    EXPECT_DOUBLE_EQ(end_x("G10 L20 P2 X100 Y0 Z0\nG54.1 P2\nX1\n"), 101);
}

TEST(GcodeMacro, SaysWhatItLeavesOut) {
    const motion::Program printed =
        macro("POPEN\nDPRNT[X#100[53]]\nPCLOS\nG21 M3 F100\nG0 X0 Y0 Z0\nG1 X5\n");
    EXPECT_TRUE(warns_of(printed, 1, "output to a printer"));
    EXPECT_DOUBLE_EQ(feed_mm(printed), 5);
    const motion::Program stopped = macro("G21 M3 F100\nG0 X0 Y0 Z0\nG1 X5\n#3000=1(NO TOOL)\nX9\n");
    EXPECT_TRUE(warns_of(stopped, 4, "an alarm: NO TOOL"));
    EXPECT_DOUBLE_EQ(feed_mm(stopped), 5);
    const motion::Program waited = macro("G21 M3 F100\nG0 X0 Y0 Z0\nG1 X5\n#3006=1(TURN)\nX9\n");
    EXPECT_TRUE(warns_of(waited, 4, "a message: TURN"));
    EXPECT_DOUBLE_EQ(feed_mm(waited), 9);
}

}  // namespace
}  // namespace tribo::readers
