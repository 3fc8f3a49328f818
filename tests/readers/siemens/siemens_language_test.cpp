// SPDX-License-Identifier: MIT
// Variables, formulas, structures, jumps and programs.
#include <gtest/gtest.h>

#include "readers/siemens/siemens_text.hpp"

namespace tribo::readers {
namespace {

// The value that a formula gives, read back as a coordinate.
double value_of(std::string_view formula, std::string_view before = "") {
    return end_of(siemens(std::string(before) + "G0 X=1000\nG0 X=" + std::string(formula) + "\n")).x;
}

TEST(SiemensLanguage, FormulasFollowTheManual) {
    const struct {
        const char* formula;
        double value;
    } cases[] = {
        {"1+2*3", 7},
        {"(1+2)*3", 9},
        {"-2*-3", 6},
        {"7 DIV 2", 3},
        {"7 MOD 4", 3},
        {"'HFF' B_AND 'B1010'", 10},
        {"6 B_OR 1", 7},
        {"NOT 0", 1},
        {"(2>1) AND (3<>3)", 0},
        {"(2>=2) OR (1==0)", 1},
        {"(2<1) XOR (1<=1)", 1},
        {"SIN(30)*10", 5},
        {"COS(60)", 0.5},
        {"TAN(45)", 1},
        {"ASIN(1)", 90},
        {"ACOS(0)", 90},
        {"ATAN2(30,-30)", 135},
        {"SQRT(POT(3)+POT(4))", 5},
        {"ABS(-2.5)", 2.5},
        {"TRUNC(-2.5)", -2},
        {"ROUND(2.5)", 3},
        {"MINVAL(2,3)+MAXVAL(2,3)", 5},
        {"BOUND(0,10,25)", 10},
        {"LN(EXP(2))", 2},
        {"1.5EX2", 150},
        {"NUMBER(\"12\"<<\".5\")", 12.5},
        {"STRLEN(\"abc\")", 3},
        {"$PI*0+1", 1},
        {"TRUE+FALSE", 1},
    };
    for (const auto& c : cases) EXPECT_NEAR(value_of(c.formula), c.value, 1e-9) << c.formula;
}

TEST(SiemensLanguage, VariablesHaveTypesArraysAndParameters) {
    EXPECT_EQ(value_of("R1+R[2]", "R1=5 R2=R1*2\n"), 15);
    EXPECT_EQ(value_of("_A+B_2", "DEF REAL _A=1.5, B_2\nB_2=_A*2\n"), 4.5);
    EXPECT_EQ(value_of("I", "DEF INT I\nI=2.6\n"), 3);  // rounded
    EXPECT_EQ(value_of("F1[1,2]", "DEF REAL F1[2,3]=SET(1,2,3,4,5,6)\n"), 6);
    EXPECT_EQ(value_of("F1[2]", "DEF REAL F1[3]=REP(7)\n"), 7);
    EXPECT_EQ(value_of("R5", "DEF STRING[8] S=\"ab\"\nIF S==\"ab\"\nR5=3\nENDIF\n"), 3);
    EXPECT_EQ(value_of("R5", "DEFINE FIVE AS R5=5\nFIVE\n"), 5);
}

TEST(SiemensLanguage, StructuresAndJumps) {
    const struct {
        const char* text;
        double r1;
    } cases[] = {
        {"IF R1==0\nR1=1\nELSE\nR1=2\nENDIF\n", 1},
        {"IF R1>0\nR1=1\nELSE\nIF R1<0\nR1=2\nELSE\nR1=3\nENDIF\nENDIF\n", 3},
        {"FOR R2=1 TO 4\nR1=R1+R2\nENDFOR\n", 10},
        {"DEF INT I\nFOR I=3 TO 1\nR1=R1+I\nENDFOR\n", 0},
        {"WHILE R1<5\nR1=R1+2\nENDWHILE\n", 6},
        {"REPEAT\nR1=R1+1\nUNTIL R1>=3\n", 3},
        {"LOOP\nR1=R1+1\nIF R1==4 GOTOF OUT\nENDLOOP\nOUT: R1=R1*10\n", 40},
        {"GOTOF A\nR1=5\nA: R1=R1+1\n", 1},
        {"B: R1=R1+1\nIF R1<3 GOTOB B\n", 3},
        {"N100 R1=R1+1\nIF R1<3 GOTO N100\n", 3},
        {"GOTOC NOWHERE\nR1=2\n", 2},
        {"R2=2\nCASE R2 OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C\nA: R1=1\nGOTOF E\nB: R1=2\nGOTOF E\nC: "
         "R1=3\nE: R2=0\n",
         2},
        {"A: R1=R1+1\nREPEAT A P=3\n", 4},
        {"A: R1=R1+1\nB: R1=R1+10\nR1=R1+100\nREPEAT A B P2\n", 133},
        {"A: R1=R1+1\nR1=R1+10\nREPEATB A P=2\n", 13},
        {"A: R1=R1+1\nENDLABEL:\nR1=R1+10\nREPEAT A\n", 12},
        {"GOTOF \"A\"<<2\nR1=1\nA2: R1=R1+2\n", 2},
    };
    for (const auto& c : cases) EXPECT_EQ(value_of("R1", c.text), c.r1) << c.text;
}

TEST(SiemensLanguage, ProgramsOfTheFileRunWithTheirParameters) {
    const std::string text = "%_N_MAIN_MPF\n" + std::string(kSiemensStart) +
                             "DEF REAL SUM=1\nLINE(5,2)\nL7 P3\nCALL \"LINE\"\nADD(4,SUM)\nG0 X=SUM\nM30\n"
                             "%_N_LINE_SPF\nPROC LINE(REAL A, INT B=1) SAVE\nG0 X=A*B\nRET\n"
                             "%_N_L7_SPF\nG0 X=IC(1)\nM17\n"
                             "PROC ADD(REAL A, VAR REAL B)\nB=B+A\nRET\n";
    const auto program = read_siemens(text);
    ASSERT_TRUE(program.has_value()) << program.error().text();
    std::vector<double> x;
    for (const motion::Move& move : program->moves) x.push_back(move.end.tip_mm.x);
    EXPECT_EQ(x, (std::vector<double>{10, 11, 12, 13, 0, 5}));
}

TEST(SiemensLanguage, ProgramsTakeArraysAndReturnThem) {
    // The sum of the parts comes back in the first; the second program takes an array of any size.
    const std::string text = std::string(kSiemensStart) +
                             "DEF REAL P[3]=SET(1,2,4)\nDEF INT Q[2,2]\nSUM(P)\nFILL(Q,5)\n"
                             "G0 X=P[0] Y=P[2] Z=Q[1,1]\nM30\n"
                             "PROC SUM(VAR REAL P[3])\nP[0]=P[0]+P[1]+P[2]\nRET\n"
                             "PROC FILL(VAR INT A[,], INT B)\nA[1,1]=B\nRET\n";
    const auto program = read_siemens(text);
    ASSERT_TRUE(program.has_value()) << program.error().text();
    expect_near(end_of(*program), {7, 4, 5}, 1e-12);
    EXPECT_FALSE(read_siemens(std::string(kSiemensStart) +
                              "DEF REAL P[2]\nSUM(P)\nM30\nPROC SUM(VAR REAL A[3])\nRET\n"));
}

TEST(SiemensLanguage, LeavesOutProgramsThatAreNotAtHandAndSaysSo) {
    const motion::Program program = siemens("G1 X5 F100\nTOOL_CHANGE(3)\nG1 X6\nG0 X0 Y0 Z5\nG1 X1\n");
    EXPECT_TRUE(warns_of(program, 5, "TOOL_CHANGE is not at hand"));
    EXPECT_TRUE(warns_of(program, 6, "1 moves that begin where only the machine knows are left out"));
    EXPECT_EQ(program.moves.size(), 2u);
}

TEST(SiemensLanguage, KeepsWhatOnlyTheMachineKnowsUntilItIsNeeded) {
    EXPECT_EQ(siemens("R1=$AC_TIMER[1]+1\nR2=R1*2\nG1 X5 F100\n").moves.size(), 1u);
    for (const char* use : {"X=R2", "X=SIN(R2)", "X=-R2"}) {
        const auto program =
            read_siemens("G71 G0 X0 Y0 Z0\nR2=$AC_TIMER[1]+1\nG0 " + std::string(use) + "\n");
        ASSERT_FALSE(program.has_value()) << use;
        EXPECT_EQ(program.error().line, 3) << use;
        EXPECT_EQ(program.error().cause, "only the machine knows this value") << use;
    }
    EXPECT_FALSE(read_siemens("IF $A_IN[1]==1 GOTOF A\nA: G0 X1\n").has_value());
}

TEST(SiemensLanguage, SaysThatAnRParameterHasNoValue) {
    const motion::Program program = siemens("TRANS X=R41\nR1=5\nG1 X=R1 F100\nX=R41\nIF R7==0\nX9\nENDIF\n");
    EXPECT_TRUE(warns_of(program, 4, "R41 has no value so far: 0 is taken"));
    EXPECT_TRUE(warns_of(program, 8, "R7 has no value so far"));
    EXPECT_FALSE(warns_of(program, 6, "has no value"));
    EXPECT_FALSE(warns_of(program, 7, "has no value"));
}

TEST(SiemensLanguage, EndsEndlessLoops) {
    GcodeOptions options;
    options.max_steps = 1000;
    for (const char* text : {"A: R1=1\nGOTOB A\n", "LOOP\nENDLOOP\n", "A: R1=1\nREPEAT A P=999999999\n"}) {
        const auto program = read_siemens(text, options);
        ASSERT_FALSE(program.has_value()) << text;
        EXPECT_NE(program.error().cause.find("does not seem to end"), std::string::npos)
            << program.error().text();
    }
}

TEST(SiemensLanguage, GathersAllRefusals) {
    std::vector<Error> refusals;
    GcodeOptions options;
    options.refusals = &refusals;
    const auto program =
        read_siemens("G71 G0 X0 Y0 Z0\nG33 Z5 K1\nTRAANG(20)\nFOO BAR\nTRAANG(30)\n", options);
    ASSERT_FALSE(program.has_value());
    ASSERT_EQ(refusals.size(), 3u);
    EXPECT_EQ(refusals[0].line, 2);
    EXPECT_EQ(refusals[1].line, 3);
    EXPECT_EQ(refusals[2].line, 4);
}

}  // namespace
}  // namespace tribo::readers
