// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "readers/gcode/flow.hpp"
#include "readers/gcode/gcode_text.hpp"

namespace tribo::readers {
namespace {

// The x of the end of each feed move of a program whose preamble is two lines long.
std::vector<double> reached(const std::string& text) {
    const motion::Program program = program_of("G21 G90 M3 F100\nG0 X0 Y0 Z0\nG1\n" + text);
    std::vector<double> all;
    for (const motion::Move& move : program.moves) all.push_back(move.end.tip_mm.x);
    return all;
}
using Reached = std::vector<double>;

TEST(GcodeExpression, HasTheValuesOfLinuxcncsRules) {
    const struct {
        const char* text;
        double value;
    } cases[] = {
        {"[1+2*3]", 7},
        {"[[1+2]*3]", 9},
        {"[2**3**2]", 64},  // from left to right
        {"[2*3**2]", 18},
        {"[10-4-3]", 3},
        {"[24/4/2]", 3},
        {"[7 MOD 4 + 1]", 4},
        {"[-7 MOD 4]", 1},
        {"[1 + 1 EQ 2]", 1},
        {"[1 LT 2 AND 3 GT 4]", 0},
        {"[1 LT 2 OR 3 GT 4]", 1},
        {"[1 XOR 1]", 0},
        {"[1 AND 0 * 2]", 0},  // the last of all
        {"[1 OR 1 + 1]", 1},
        {"[1 EQ 1.00009]", 1},  // equal within 0.0001
        {"[1 NE 1.00011]", 1},
        {"[2 GE 2]", 1},
        {"[2 LE 1]", 0},
        {"-[2+3]", -5},
        {"[- -4]", 4},
        {"SIN[30]", 0.5},
        {"[2*COS[60]]", 1},
        {"TAN[45]", 1},
        {"ATAN[1]/[-1]", 135},
        {"ASIN[0.5]", 30},
        {"ACOS[0.5]", 60},
        {"SQRT[2]", std::sqrt(2.0)},
        {"EXP[1]", std::exp(1.0)},
        {"LN[10]", std::log(10.0)},
        {"ABS[-3]", 3},
        {"FIX[-2.8]", -3},
        {"FIX[2.8]", 2},
        {"FUP[2.2]", 3},
        {"FUP[-2.8]", -2},
        {"ROUND[2.5]", 3},
        {"ROUND[-2.5]", -3},
        {"[.5 + 1.]", 1.5},
        {"[ 1 + 2 ]", 3},
    };
    for (const auto& c : cases) {
        const Reached all = reached(std::string("X[") + c.text + "+ 100]\n");
        ASSERT_EQ(all.size(), 1U) << c.text;
        EXPECT_NEAR(all[0], c.value + 100, 1e-12) << c.text;
    }
}

TEST(GcodeParameters, HoldNumbersAndNames) {
    EXPECT_EQ(reached("#1=5 #2=[#1+1]\nX#2\n"), Reached{1});  // #1 counts from the next block on
    EXPECT_EQ(reached("#1=5\n#2=[#1+1]\nX#2\n"), Reached{6});
    EXPECT_EQ(reached("#3=4\n#4=7\nX##3\n"), Reached{7});
    EXPECT_EQ(reached("#[1+1]=3\nX-#2\n"), Reached{-3});
    EXPECT_EQ(reached("#<Some Name>=2\nX[#<somename>*2]\n"), Reached{4});
    EXPECT_EQ(reached("#1=1 X#1\n#1=2\nX#1\n"), Reached{2});
    EXPECT_EQ(reached("X[EXISTS[#<a>]+1]\n#<a>=0\nX[EXISTS[#<a>]+1]\n"), (Reached{1, 2}));
    EXPECT_TRUE(warns_of(program_of("G21 G0 X0 Y0 Z0\nX#7\n"), 2, "#7 has no value so far"));
}

TEST(GcodeParameters, ShowTheStateOfTheControl) {
    EXPECT_EQ(reached("X3\nX[#5420+1]\nX[#<_x>*2]\n"), (Reached{3, 4, 8}));
    EXPECT_EQ(reached("X[1+#<_line>]\n"), Reached{5});  // line 4
    EXPECT_EQ(reached("X[10+#<_metric>-#<_imperial>+2*#<_absolute>]\n"), Reached{13});
    EXPECT_EQ(reached("X#<_feed>\n"), Reached{100});
    EXPECT_EQ(reached("T5 M6\nX#5400\nX[#<_current_tool>+1]\n"), (Reached{5, 6}));
    EXPECT_EQ(reached("G10 L2 P2 X7\nX#5241\nG55\nX#5220\n"), (Reached{7, 9}));
    EXPECT_EQ(reached("G92 X-4\nX#5211\n"), Reached{8});
    // In inches a position counts in inches.
    EXPECT_NEAR(reached("X25.4\nG20\nX[#5420*2]\n").at(1), 50.8, 1e-12);
}

TEST(GcodeFlow, TakesTheFirstBranchThatIsTrue) {
    const auto text = [](int n) {
        return "#1=" + std::to_string(n) +
               "\no1 if [#1 EQ 1]\nX1\no1 elseif [#1 EQ 2]\nX2\no1 elseif [#1 EQ 2]\nX22\no1 else\nX3\no1 "
               "endif\n"
               "X9\n";
    };
    EXPECT_EQ(reached(text(1)), (Reached{1, 9}));
    EXPECT_EQ(reached(text(2)), (Reached{2, 9}));
    EXPECT_EQ(reached(text(3)), (Reached{3, 9}));
    EXPECT_EQ(reached("o1 if [0]\nX1\no1 endif\nX9\n"), Reached{9});
    // An elseif that is not asked is not computed.
    EXPECT_EQ(reached("o1 if [1]\nX1\no1 elseif [1/0]\nX2\no1 endif\n"), Reached{1});
}

TEST(GcodeFlow, RunsLoopsAsOftenAsTheyAsk) {
    EXPECT_EQ(reached("#1=0\no1 while [#1 LT 3]\n#1=[#1+1]\nX#1\no1 endwhile\n"), (Reached{1, 2, 3}));
    EXPECT_EQ(reached("#1=0\no1 while [#1 LT 0]\nX#1\no1 endwhile\nX5\n"), Reached{5});
    EXPECT_EQ(reached("#1=0\no1 do\n#1=[#1+1]\nX#1\no1 while [#1 LT 3]\nX9\n"), (Reached{1, 2, 3, 9}));
    EXPECT_EQ(reached("#1=0\no1 repeat [3]\n#1=[#1+1]\nX#1\no1 endrepeat\n"), (Reached{1, 2, 3}));
    EXPECT_EQ(reached("o1 repeat [0]\nX1\no1 endrepeat\nX2\n"), Reached{2});
    // Loops within each other, and a label used twice.
    EXPECT_EQ(reached("#1=0\no1 repeat [2]\no2 repeat [2]\n#1=[#1+1]\nX#1\no2 endrepeat\no1 endrepeat\n"
                      "o1 repeat [1]\nX8\no1 endrepeat\n"),
              (Reached{1, 2, 3, 4, 8}));
}

TEST(GcodeFlow, LeavesLoopsByBreakAndContinue) {
    EXPECT_EQ(
        reached("#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 3]\no1 break\no2 endif\nX#1\no1 endwhile\nX9\n"),
        (Reached{1, 2, 9}));
    EXPECT_EQ(
        reached(
            "#1=0\no1 repeat [4]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nX#1\no1 endrepeat\n"),
        (Reached{1, 3, 4}));
    EXPECT_EQ(
        reached("#1=0\no1 do\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nX#1\no1 while [#1 LT 4]\n"),
        (Reached{1, 3, 4}));
    // Out of two loops at once, from within the inner one.
    EXPECT_EQ(
        reached("#1=0\no1 repeat [3]\no2 repeat [3]\n#1=[#1+1]\nX#1\no1 break\no2 endrepeat\no1 endrepeat\n"
                "o3 repeat [2]\nX[#1+10]\n#1=[#1+1]\no3 endrepeat\n"),
        (Reached{1, 11, 12}));
}

TEST(GcodeFlow, CallsSubroutinesWithTheirOwnParameters) {
    EXPECT_EQ(reached("o1 sub\nX#1\nX[#1+#2]\n#1=99\no1 endsub\n#1=7\no1 call [2] [3]\nX#1\n"),
              (Reached{2, 5, 7}));
    EXPECT_EQ(reached("#<a>=1\no1 sub\nX[EXISTS[#<a>]+2]\n#<_b>=4\no1 endsub\no1 call\nX#<_b>\n"),
              (Reached{2, 4}));
    EXPECT_EQ(reached("o<Way>call [3]\no<way> sub\nX#1\no<way> endsub\n"), Reached{3});
    EXPECT_EQ(reached("o007 sub\nX#1\no7 endsub\no[3+4] call [8]\n"), Reached{8});
    EXPECT_EQ(reached("o1 sub\no2 if [#1 GT 1]\no1 return [#1*2]\no2 endif\nX1\no1 endsub [5]\n"
                      "o1 call [4]\nX#<_value>\no1 call [0]\nX#<_value>\n"),
              (Reached{8, 1, 5}));
    // A return out of a loop leaves no count behind.
    EXPECT_EQ(reached("o1 sub\no2 repeat [5]\nX#1\no1 return\no2 endrepeat\no1 endsub\n"
                      "o3 repeat [2]\no1 call [1]\no1 call [2]\no3 endrepeat\n"),
              (Reached{1, 2, 1, 2}));
}

TEST(GcodeFlow, CallsItselfToAnyDepthBelowTheLimit) {
    // 20 levels down and up again: the factorial of 20 fits a double exactly.
    EXPECT_EQ(reached("o1 sub\no2 if [#1 LE 1]\no1 return [1]\no2 endif\no1 call [#1-1]\n"
                      "o1 endsub [#1*#<_value>]\no1 call [20]\nX[#<_value>/ 2432902008176640000]\n"),
              Reached{1});
}

TEST(GcodeFlow, RunsFanucSubprograms) {
    const char* const text =
        "O1\nG21 G90 M3 F100\nG0 X0 Y0 Z0\nG1 M98 P1000 L3\nX50\nM30\n"
        "O1000 (STEP)\nG91 X1\nG90\nM98 P1001\nM99\nO1001\nX#1 (as M98 has no arguments)\nM99\n%\n";
    Reached all;
    for (const motion::Move& move : program_of(text).moves) all.push_back(move.end.tip_mm.x);
    EXPECT_EQ(all, (Reached{1, 0, 1, 0, 1, 0, 50}));
    EXPECT_TRUE(warns_of(program_of("G21 G0 X0 Y0 Z0\nX1\nM99\n"), 3, "ends here"));
}

TEST(GcodeFlow, BeginsWithTheProgramThatTheOperatorStarts) {
    const auto main_of = [](const std::string& first, const std::string& second) {
        const motion::Program program = program_of("%\nO7" + first + "%\nO1 (MAIN)\n" + second + "%\n");
        return program.moves.empty() ? 0 : program.moves.back().end.tip_mm.x;
    };
    const std::string part = "\nG21 G90 M3 F100\nG0 X0 Y0 Z0\nG1 X2\n";
    const std::string other = "G21 G90 M3 F100\nG0 X0 Y0 Z0\nG1 X5\n";
    EXPECT_EQ(main_of(part + "M99 (M30)\n", other + "M98 P7\nX6\nM30\n"), 6);
    // The first one is a main program, or no other one is.
    EXPECT_EQ(main_of(part + "M30\n", other + "M30\n"), 2);
    EXPECT_EQ(main_of(part + "M99\n", other + "M99\n"), 2);
}

TEST(GcodeFlow, CountsDeletableLinesAsTheSwitchSays) {
    const std::string text = "G21 G90 M3 F100\nG0 X0 Y0 Z0\nG1\n/o1 if [0]\nX1\n/o1 endif\nX2\n";
    EXPECT_EQ(program_of(text).moves.size(), 2U);
    GcodeOptions options;
    options.skip_deletable_blocks = false;
    EXPECT_EQ(program_of(text, options).moves.size(), 1U);
}

}  // namespace
}  // namespace tribo::readers
