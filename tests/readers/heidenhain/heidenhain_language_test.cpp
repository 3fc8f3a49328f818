// SPDX-License-Identifier: MIT
// Conversational programs as posts and people write them: what is passed over and said, names, parameters,
// the cycles and patterns beyond 200 to 203.
#include <cmath>
#include <gtest/gtest.h>

#include "readers/heidenhain/heidenhain_text.hpp"

namespace tribo::readers {
namespace {

TEST(HeidenhainLanguage, PassesOverAndSaysWhatDoesNotMoveTheTool) {
    const motion::Program program = conversational(after_start(R"(* - operation 1
3 L X+10 F100 M77 M88
4 SEL TABLE "TNC:\A.D"
5 FUNCTION FEED DWELL F5 S1
6 STOP M5
7 FN 16: F-PRINT A.A / SCREEN:
8 CYCLE DEF 32.0 TOLERANCE
9 CYCL DEF 32.1 T0.01
/ L X+500
10 FN 26: TABOPEN A.TAB
11 L X+20 M77
)"));
    ASSERT_EQ(program.moves.size(), 2U);
    EXPECT_TRUE(warns_of(program, 5, "M77 is passed over"));
    EXPECT_TRUE(warns_of(program, 5, "M88 is passed over"));
    EXPECT_TRUE(warns_of(program, 6, "SEL is passed over"));
    EXPECT_TRUE(warns_of(program, 12, "begin with '/'"));
    EXPECT_FALSE(warns_of(program, 14, "M77"));
}

TEST(HeidenhainLanguage, NumbersNamedTools) {
    const motion::Program program = conversational(after_start(R"(3 QS1 = "CUT" || "TER"
4 TOOL CALL "MILL ; 10" Z S1000 F300 DR2+0.1
5 L X+10 M3
6 TOOL CALL QS1 S500
7 L X+20
8 TOOL CALL "MILL ; 10"
9 L X+30
10 TOOL CALL 3.1 Z
)"));
    ASSERT_EQ(program.moves.size(), 3U);
    EXPECT_EQ(program.moves[0].tool, 2);
    EXPECT_EQ(program.moves[1].tool, 4);
    EXPECT_EQ(program.moves[1].spindle_rpm, 500);
    EXPECT_EQ(program.moves[2].tool, 2);
    EXPECT_TRUE(warns_of(program, 5, "the tool \"MILL ; 10\" counts as tool 2"));
    EXPECT_TRUE(warns_of(program, 7, "the tool \"CUTTER\" counts as tool 4"));
}

TEST(HeidenhainLanguage, TakesToolsFromTheListInTheHeader) {
    const motion::Program program = conversational(
        "0 BEGIN PGM P MM\n1 ; Tools\n2 ;  #3 D=10 CR=0.5 - ZMIN=-4.5 - flat end mill\n3 TOOL CALL 3 Z "
        "S100\n");
    ASSERT_EQ(program.tools.size(), 1U);
    EXPECT_EQ(program.tools[0].number, 3);
    EXPECT_EQ(program.tools[0].diameter_mm, 10);
    EXPECT_EQ(program.tools[0].corner_mm, 0.5);
}

// No control counts so far: the number is that of a tool library, and the call has a name.
TEST(HeidenhainLanguage, TakesNumbersOfToolLibrariesForNone) {
    for (const char* number : {"T21780198", "T1755863337"}) {
        const motion::Program program = conversational(
            "0 BEGIN PGM P MM\n1 ; " + std::string(number) + " | A_10 / DM=8 CR=1\n2 * - TOOL: " + number +
            " | A_10 / DM=8 CR=1\n3 TOOL CALL \"A0800\" Z S100\n4 L X+0 Y+0 Z+0 FMAX\n5 L X+9 F100\n");
        ASSERT_EQ(program.tools.size(), 1U);
        EXPECT_EQ(program.tools[0].number, 1);
        EXPECT_EQ(program.tools[0].diameter_mm, 8);
        EXPECT_EQ(program.tools[0].corner_mm, 1);
    }
}

TEST(HeidenhainLanguage, KeepsLocalAndRemanentParametersApart) {
    const motion::Program program = conversational(after_start(
        "Q1 = 1\nQL1 = Q1 + 10\nQR1 = QL1 + 100\nL X+QL1 Y+QR1 Z + Q1 FQL1\nQS2 = \"UP\"\nCALL LBL QS2\n"
        "M30\nLBL \"UP\"\nL IZ+1\nLBL 0\n"));
    ASSERT_EQ(program.moves.size(), 2U);
    expect_near(program.moves[0].end.tip_mm, {11, 111, 1});
    EXPECT_EQ(program.moves[0].feed_mm_per_min, 11);
    expect_near(program.moves[1].end.tip_mm, {11, 111, 2});
}

TEST(HeidenhainLanguage, ReadsOfTheSystemWhatTheProgramHasSet) {
    const motion::Program program = conversational(
        after_start("L X+4 F100\nFN18: SYSREAD Q1 = ID270 NR1 IDX1\nL Y+Q1\nFN 18: SYSREAD Q2 = ID20 NR4\n"
                    "L X+Q2\nFN 18: SYSREAD Q3 = ID230 NR2\n"));
    ASSERT_EQ(program.moves.size(), 3U);
    expect_near(program.moves[1].end.tip_mm, {4, 4, 10});
    expect_near(program.moves[2].end.tip_mm, {2000, 4, 10});
    EXPECT_TRUE(warns_of(program, 9, "Q3 has no value"));
}

TEST(HeidenhainLanguage, LeavesOutProgramsThatAreNotAtHand) {
    const motion::Program program =
        conversational(after_start("CALL PGM TNC:\\HOME.H\nL X+5 Y+5 FMAX\nL Z+5 FMAX\nL X+9 F100\n"));
    ASSERT_EQ(program.moves.size(), 1U);
    expect_near(program.moves[0].start.tip_mm, {5, 5, 5});
    EXPECT_TRUE(warns_of(program, 4, "TNC:\\HOME.H is not at hand"));
}

TEST(HeidenhainLanguage, LeavesOutTheLinesJoinedToACommentOrASkippedBlock) {
    const motion::Program program = conversational(after_start(
        "3 ;WHAT THIS IS ~\n FOR ~\n IS TOLD HERE\n* A HEADING ~\n OF TWO\n4 Q200 = 3\n"
        "/ 5 CYCL DEF 200 ~\n   Q200=7 ~\n   Q201=-9\n6 ;~~~~~\nL X+Q200 F100\n7 ; ~\n8 L X+5\n"));
    ASSERT_EQ(program.moves.size(), 2U);
    EXPECT_NEAR(program.moves[0].end.tip_mm.x, 3, 1e-12);
    EXPECT_NEAR(program.moves[1].end.tip_mm.x, 5, 1e-12);
}

// Behind a statement the comment goes on; behind the parameter of a cycle the list does.
TEST(HeidenhainLanguage, TakesTheNextLineForTheRestOfAComment) {
    const motion::Program program = conversational(after_start(
        "3 Q1 = ( 9 - 5 ) / 2 ; (half of the key ~\n width minus the cutter)\n4 L X+Q1 F100 ; to ~\nthe "
        "left\n"
        "5 CYCL DEF 200 ~\n   Q200=2 ;CLEARANCE ~\n   Q201=-5 ;DEPTH ~\n   Q206=100 ~\n   Q202=5 ~\n"
        "   Q203=0 ~\n   Q204=20\n6 L X+9 FMAX M99\n"));
    EXPECT_NEAR(program.moves[0].end.tip_mm.x, 2, 1e-12);
    EXPECT_NEAR(std::ranges::min(heights(program)), -5, 1e-12);
}

TEST(HeidenhainLanguage, CountsFeedsPerTurn) {
    const motion::Program program = conversational(
        after_start("L X+5 FU0.1\nL X+9 F100\nL X+12 F0.2 M136\nL X+15 F0.2\nL X+20 F300 M137\n"
                    "L X+30 F300\n"));
    ASSERT_EQ(program.moves.size(), 6U);
    EXPECT_NEAR(program.moves[0].feed_mm_per_min, 200, 1e-9);
    EXPECT_NEAR(program.moves[3].feed_mm_per_min, 400, 1e-9);
    EXPECT_NEAR(program.moves[5].feed_mm_per_min, 300, 1e-9);
    // In TOOL CALL the speed may stand behind the feed.
    const motion::Program called =
        conversational(after_start("TOOL CALL 1 Z FU0.1 S900\nL X+5 M3\nL X+9 F50\nL X+12 FAUTO\n"));
    ASSERT_EQ(called.moves.size(), 3U);
    EXPECT_NEAR(called.moves[0].feed_mm_per_min, 90, 1e-9);
    EXPECT_NEAR(called.moves[2].feed_mm_per_min, 90, 1e-9);
}

TEST(HeidenhainLanguage, CountsFeedsPerToothByTheToolsOfTheJob) {
    GcodeOptions options;
    options.tools = {{1, 10, {}, 4}};
    const std::string text = after_start("TOOL CALL 1 Z S900 FZ0.05\nL X+5 M3 FAUTO\nL X+9 FZ0.1\n");
    const motion::Program program = conversational(text, options);
    ASSERT_EQ(program.moves.size(), 2u);
    EXPECT_NEAR(program.moves[0].feed_mm_per_min, 4 * 0.05 * 900, 1e-9);
    EXPECT_NEAR(program.moves[1].feed_mm_per_min, 4 * 0.1 * 900, 1e-9);
    // A tool of the job without a number stands for every one that has no entry.
    options.tools = {{0, 10, {}, 3}, {2, 6, {}, 2}};
    EXPECT_NEAR(conversational(text, options).moves[1].feed_mm_per_min, 3 * 0.1 * 900, 1e-9);
}

TEST(HeidenhainLanguage, RetractsAlongTheTool) {
    const motion::Program program =
        conversational(after_start("L Z-5 F100\nL M140 MB 20 FMAX\nM140 MB MAX\nL Z+3 FMAX\nL X+5\n"));
    ASSERT_EQ(program.moves.size(), 3U);
    expect_near(program.moves[1].end.tip_mm, {0, 0, 15});
    EXPECT_EQ(program.moves[1].kind, motion::MoveKind::rapid);
    // After MB MAX X and Y stand, Z is stated again.
    expect_near(program.moves[2].start.tip_mm, {0, 0, 3});
}

TEST(HeidenhainLanguage, DrillsInPatterns) {
    const std::string cycle =
        "CYCL DEF 200 DRILLING Q200=2 Q201=-5 Q206=150 Q202=5 Q210=0 Q203=0 Q204=20 Q211=0\n";
    const struct {
        const char* pattern;
        std::vector<Vec3> holes;  // bottoms
    } cases[] = {
        {"PATTERN DEF ~\nPOS1 (X+10 Y+20 Z+0) ~\nPOS2 ( X+30 Y+40 Z-1 )\nCYCL CALL PAT FMAX M3\n",
         {{10, 20, -5}, {30, 40, -6}}},
        {"PATTERN DEF ROW1 (X+10 Y+0 D+5 NUM3 ROT+90 Z+0)\nCYCL CALL PAT\n",
         {{10, 0, -5}, {10, 5, -5}, {10, 10, -5}}},
        {"PATTERN DEF PAT1 (X+1 Y+2 DX+10 DY+20 NUMX2 NUMY2 ROT+0 ROTX+0 ROTY+0 Z+0)\nCYCL CALL PAT\n",
         {{1, 2, -5}, {11, 2, -5}, {11, 22, -5}, {1, 22, -5}}},
        {"PATTERN DEF FRAME1 (X+0 Y+0 DX+10 DY+10 NUMX3 NUMY3 ROT+0 Z+0)\nCYCL CALL PAT\n",
         {{0, 0, -5},
          {10, 0, -5},
          {20, 0, -5},
          {20, 10, -5},
          {0, 10, -5},
          {0, 20, -5},
          {10, 20, -5},
          {20, 20, -5}}},
        {"PATTERN DEF CIRC1 (X+50 Y+0 D+20 START+0 NUM4 Z+0)\nCYCL CALL PAT\n",
         {{60, 0, -5}, {50, 10, -5}, {40, 0, -5}, {50, -10, -5}}},
        {"PATTERN DEF PITCHCIRC1 (X+0 Y+0 D+20 START+90 STEP-90 NUM2 Z+0)\nCYCL CALL PAT\n",
         {{0, 10, -5}, {10, 0, -5}}},
        {"CYCL DEF 220 PATTERN ~\nQ216=+50 ~\nQ217=+0 ~\nQ244=20 ~\nQ245=+0 ~\nQ246=+360 ~\nQ247=0 ~\nQ241=4 "
         "~\nQ200=2 ~\nQ203=+1 ~\nQ204=20 ~\nQ301=1\n",
         {{60, 0, -4}, {50, 10, -4}, {40, 0, -4}, {50, -10, -4}}},
        {"CYCL DEF 221 PATTERN ~\nQ225=+1 ~\nQ226=+2 ~\nQ237=10 ~\nQ238=20 ~\nQ242=2 ~\nQ243=2 ~\nQ224=0\n",
         {{1, 2, -5}, {11, 2, -5}, {11, 22, -5}, {1, 22, -5}}},
    };
    for (const auto& c : cases) {
        const motion::Program program = conversational(after_start(cycle + c.pattern));
        std::vector<Vec3> holes;
        for (const motion::Move& move : program.moves) {
            if (move.kind == motion::MoveKind::feed) holes.push_back(move.end.tip_mm);
        }
        ASSERT_EQ(holes.size(), c.holes.size()) << c.pattern;
        for (std::size_t k = 0; k < holes.size(); ++k) expect_near(holes[k], c.holes[k], 1e-9);
        EXPECT_EQ(program.moves.back().end.tip_mm.z, c.holes.back().z + 25) << c.pattern;
    }
}

TEST(HeidenhainLanguage, CallsACycleWhereOnlyXAndYAreStated) {
    const std::string cycle = "CYCL DEF 201 Q200=2 Q201=-5 Q206=100 Q203=+10 Q204=30\n";
    for (const char* before : {"M140 MB MAX\n", "L Z-1 R0 FMAX M91\n", "L X-1 Y-1 Z-1 R0 FMAX M92\n"}) {
        const motion::Program program =
            conversational(after_start(before + cycle + "L X+20 Y+5 R0 FMAX M99\nL X+40 FMAX M99\n"));
        std::vector<Vec3> holes;
        for (const motion::Move& move : program.moves) {
            if (move.kind == motion::MoveKind::feed && move.end.tip_mm.z < 6)
                holes.push_back(move.end.tip_mm);
        }
        ASSERT_EQ(holes.size(), 2U) << before;
        expect_near(holes[0], {20, 5, 5});
        expect_near(holes[1], {40, 5, 5});
        EXPECT_EQ(program.moves.back().end.tip_mm.z, 40);
    }
    // A cycle that begins where the tool is has no height there.
    const motion::Program old = conversational(
        after_start("M140 MB MAX\nCYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SETUP 2\nCYCL DEF 1.2 DEPTH -5\nCYCL "
                    "DEF 1.3 PECKG 5\nCYCL DEF 1.4 DWELL 0\nCYCL DEF 1.5 F50\nL X+20 Y+5 R0 FMAX M99\n"));
    EXPECT_EQ(feed_mm(old), 0);
}

TEST(HeidenhainLanguage, PecksDeepAndTapsAndCentres) {
    const motion::Program deep = conversational(after_start(
        "CYCL DEF 205 UNIVERSAL PECKING ~\nQ200=2 ~\nQ201=-10 ~\nQ206=150 ~\nQ202=6 ~\nQ203=+0 ~\nQ204=2 ~\n"
        "Q212=0 ~\nQ205=0 ~\nQ258=0.5 ~\nQ259=0.5 ~\nQ257=4 ~\nQ256=0.2 ~\nQ211=0 ~\nQ379=0 ~\nQ253=750\n"
        "L M99\n"));
    EXPECT_EQ(heights(deep), (std::vector<double>{2, -4, -3.8, -6, 2, -5.5, -10, 2}));

    const motion::Program tapped = conversational(after_start(
        "CYCL DEF 207 RIGID TAPPING ~\nQ200=3 ~\nQ201=-10 ~\nQ239=+1.5 ~\nQ203=+0 ~\nQ204=20\nCYCL CALL\n"));
    EXPECT_EQ(heights(tapped), (std::vector<double>{3, -10, 3, 20}));
    EXPECT_EQ(tapped.moves[1].feed_mm_per_min, 3000);
    EXPECT_EQ(tapped.moves[2].feed_mm_per_min, 3000);

    const motion::Program centred =
        conversational(after_start("CYCL DEF 240 CENTERING ~\nQ200=2 ~\nQ343=1 ~\nQ201=-2 ~\nQ344=-6 "
                                   "~\nQ206=150 ~\nQ211=0 ~\nQ203=+0 ~\n"
                                   "Q204=2\nCYCL CALL\n"));
    EXPECT_NEAR(centred.moves[1].end.tip_mm.z, -3, 1e-12);  // a cone of 90 degrees, 6 mm wide
    EXPECT_TRUE(warns_of(centred, 4, "a point of 90 degrees is taken"));

    // As a post of NX writes it: only the first line has a '~'.
    const motion::Program listed =
        conversational(after_start("4 CYCL DEF 240 CENTERING ~\n  Q200=2 ;CLEARANCE\n  Q201=-3 ;DEPTH\n"
                                   "  Q206=150 ;FEED\n  Q203=+0 ;SURFACE\n  Q204=2\n5 L X+5 FMAX M99\n"));
    EXPECT_EQ(heights(listed), (std::vector<double>{10, 2, -3, 2}));

    const motion::Program lip = conversational(after_start(
        "CYCL DEF 241 SINGLE-LIP D.H.DRLNG Q200=2 Q201=-50 Q206=100 Q211=0 Q203=0 Q204=5 Q379=10 Q253=700 "
        "Q208=900\nCYCL CALL\n"));
    EXPECT_EQ(heights(lip), (std::vector<double>{2, -10, -50, 2, 5}));
    EXPECT_EQ(lip.moves[1].feed_mm_per_min, 700);
    EXPECT_EQ(lip.moves[3].feed_mm_per_min, 900);
    // It turns slower on the way in and out.
    const motion::Program speeds = conversational(after_start(
        "CYCL DEF 241 SINGLE-LIP D.H.DRLNG Q200=2 Q201=-50 Q206=100 Q211=0 Q203=0 Q204=5 Q379=10 Q253=700 "
        "Q208=900 Q427=50 Q428=1790\nCYCL CALL\nL X+9 F50\n"));
    EXPECT_EQ(speeds.moves[1].spindle_rpm, 50);
    EXPECT_EQ(speeds.moves[2].spindle_rpm, 1790);
    EXPECT_EQ(speeds.moves[3].spindle_rpm, 50);
    EXPECT_EQ(speeds.moves[5].spindle_rpm, lip.moves[0].spindle_rpm);
}

TEST(HeidenhainLanguage, RunsTheCyclesOfOldControls) {
    const motion::Program pecked = conversational(after_start(
        "CYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SET UP 10\nCYCL DEF 1.2 DEPTH-8\nCYCL DEF 1.3 PECKG5\n"
        "CYCL DEF 1.4 V.ZEIT 0.5\nCYCL DEF 1.5 F671\nL X+5 FMAX M99\n"));
    // From 10 above the surface: 5, back to 0.6 above it, 8, and out.
    EXPECT_EQ(heights(pecked), (std::vector<double>{10, -5, 10, -4.4, -8, 10}));
    EXPECT_EQ(pecked.moves[1].feed_mm_per_min, 671);

    const motion::Program tapped = conversational(after_start(
        "CYCL DEF 17.0 RIGID TAPPING\nCYCL DEF 17.1 SET UP 10\nCYCL DEF 17.2 DEPTH-8\nCYCL DEF 17.3 PITCH+1\n"
        "CYCL CALL\n"));
    EXPECT_EQ(heights(tapped), (std::vector<double>{-8, 10}));
    EXPECT_EQ(tapped.moves[1].feed_mm_per_min, 2000);
}

TEST(HeidenhainLanguage, MillsABoreAlongAHelix) {
    const motion::Program program = conversational(
        "0 BEGIN PGM P MM\n1 TOOL DEF 1 L+0 R+5\n2 TOOL CALL 1 Z S2000 F500\n3 L X+0 Y+0 Z+2 FMAX M3\n"
        "4 CYCL DEF 208 BORE MILLING ~\nQ200=2 ~\nQ201=-8 ~\nQ206=150 ~\nQ334=4 ~\nQ203=+0 ~\nQ204=50 ~\n"
        "Q335=30 ~\nQ342=0 ~\nQ351=1\n5 CYCL CALL\n");
    // Half a circle of radius 5 to the orbit of radius 10, two and a half turns over 10 mm, a full circle,
    // back.
    ASSERT_EQ(program.moves.size(), 6U);
    EXPECT_NEAR(length_of(program, 0), 5 * kPi, 1e-9);
    EXPECT_NEAR(length_of(program, 1), std::hypot(2.5 * 20 * kPi, 10), 1e-9);
    EXPECT_NEAR(length_of(program, 2), 20 * kPi, 1e-9);
    expect_near(program.moves[2].end.tip_mm, {-10, 0, -8}, 1e-9);
    EXPECT_NEAR(length_of(program, 3), 10, 1e-9);
    expect_near(program.moves[5].end.tip_mm, {0, 0, 50}, 1e-9);
}

TEST(HeidenhainLanguage, SaysWhichCoreABoreKeeps) {
    // A tool of 10 mm clears a ring of that width along the wall: the core is 20 mm thinner than the bore.
    const auto bored = [](const std::string& diameters) {
        return conversational(
            "0 BEGIN PGM P MM\n1 TOOL DEF 1 L+0 R+5\n2 TOOL CALL 1 Z S2000 F500\n3 L X+0 Y+0 Z+2 FMAX M3\n"
            "4 CYCL DEF 208 BORE MILLING Q200=2 Q201=-8 Q206=150 Q334=4 Q203=+0 " +
            diameters + "\n5 CYCL CALL\n6 CYCL CALL\n");
    };
    const motion::Program cored = bored("Q335=30 Q342=0");
    EXPECT_TRUE(warns_of(cored, 5, "leaves a core of 10 mm"));
    EXPECT_TRUE(warns_of(cored, 5, "the control refuses that while Q342 is 0"));
    EXPECT_EQ(cored.warnings.size(), 1U);
    EXPECT_TRUE(warns_of(bored("Q335=30 Q342=4"), 5, "Q342 says that 4 mm are drilled before"));
    EXPECT_TRUE(bored("Q335=20 Q342=0").warnings.empty());
    EXPECT_TRUE(bored("Q335=30 Q342=10").warnings.empty());
}

TEST(HeidenhainLanguage, TiltsWithCycle19) {
    const motion::Program program = conversational(after_start(R"(3 CYCL DEF 19.0 WORKING PLANE
4 CYCL DEF 19.1 A+0 B+90 C+0 F2000
5 L B+Q121 C+Q122 R0 FMAX
6 L X+0 Y+0 Z+20 R0 FMAX
7 L Z+1 F100
8 CYCL DEF 19.0 WORKING PLANE
9 CYCL DEF 19.1 A+0 B+0 C+0
)"));
    ASSERT_EQ(program.moves.size(), 1U);
    expect_near(program.moves[0].start.tip_mm, {20, 0, 0}, 1e-12);
    expect_near(program.moves[0].end.axis, {1, 0, 0}, 1e-12);
}

TEST(HeidenhainLanguage, TurnsAPlaneFromTheOneInForce) {
    const motion::Program program = conversational(
        after_start("PLANE SPATIAL SPA+0 SPB+60 SPC+0 STAY\nPLANE RELATIV SPB+30 STAY\nL X+0 Y+0 Z+20 FMAX\n"
                    "PLANE RELATIV SPB+0 TURN FMAX\nL Z+1 F100\n"));
    ASSERT_EQ(program.moves.size(), 1U);  // a plane that does not turn keeps the place
    expect_near(program.moves[0].start.tip_mm, {20, 0, 0}, 1e-12);
    expect_near(program.moves[0].end.axis, {1, 0, 0}, 1e-12);
}

TEST(HeidenhainLanguage, ReadsParametersAsListingsWriteThem) {
    const std::string joined =
        "CYCL DEF 200 DRILLING ~\n Q200=2 ;CLEARANCE ~\n Q201=-5 ~\n Q206=150 ~\n Q203=0\nM99\n";
    // Without '~', as the listings of manuals have it.
    const std::string listed =
        "CYCL DEF 200 DRILLING\n Q200 = 2 ;CLEARANCE\nQ201=-5\nQ206=150\nQ203=0\nM99\n";
    EXPECT_EQ(heights(conversational(after_start(listed))), heights(conversational(after_start(joined))));
    // Block numbers with N, and a sheet of remarks before the program, as training systems write them.
    const motion::Program numbered = conversational(
        "( Set-up sheet\n(   T01: \"END MILL\"\nBEGIN PGM P MM\nN1 TOOL CALL 1 Z S2000 F500\n"
        "N2 L X+0 Y+0 Z+10 R0 FMAX M3\nN3 L X+20\nN4 END PGM P MM\n");
    EXPECT_EQ(feed_mm(numbered), 20);
}

TEST(HeidenhainLanguage, ReadsTheParametersOfACycleWhereItIsCalled) {
    const motion::Program program = conversational(
        after_start("CYCL DEF 201 REAMING Q200=2 Q201=-5 Q206=150 Q203=0\nM99\nQ201=-18\nL X+10 FMAX M99\n"));
    // Down and up from the clearance of 2 mm, at feed.
    EXPECT_NEAR(feed_mm(program), 2 * (2 + 5) + 2 * (2 + 18), 1e-9);
}

TEST(HeidenhainLanguage, RunsOldCyclesAtPatterns) {
    // Cycle 1 from 2 mm above the surface: 7 mm down at each of two points.
    const motion::Program program = conversational(after_start(
        "CYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SET UP 2\nCYCL DEF 1.2 DEPTH -5\nCYCL DEF 1.3 PECKG 5\n"
        "CYCL DEF 1.4 DWELL 0\nCYCL DEF 1.5 F100\nCYCL DEF 220 Q216=0 Q217=0 Q244=20 Q245=0 Q246=360 Q247=0 "
        "Q241=2 Q200=2 Q203=-3 Q204=20\n"));
    EXPECT_NEAR(feed_mm(program), 2 * 7, 1e-9);
    double bottom = 0;
    for (const motion::Move& move : program.moves) bottom = std::min(bottom, move.end.tip_mm.z);
    EXPECT_NEAR(bottom, -8, 1e-12);
}

TEST(HeidenhainLanguage, LeavesOutCyclesOfTheMachinesMaker) {
    const motion::Program program = conversational(after_start(
        "CYCL DEF 392 ATC~\n  Q240=0 ;MODE~\n  Q241=1\nL X+5 Y+0 FMAX\nL Z+2 FMAX\nL X+9 F100\n"));
    EXPECT_TRUE(warns_of(program, 4, "cycle 392 is one of the machine's maker"));
    EXPECT_EQ(feed_mm(program), 4);
}

TEST(HeidenhainLanguage, TakesTheRadiusOfCyclesFromComments) {
    const std::string bore = "CYCL DEF 208 BORE Q200=2 Q201=-4 Q206=90 Q334=2 Q203=0 Q335=20\n";
    const std::string described =
        "0 BEGIN PGM P MM\n1 TOOL CALL 1 Z S2000 F500 ;END MILL D=8\n2 L X+0 Y+0 Z+10 R0 FMAX M3\n" + bore +
        "4 M99\n5 END PGM P MM\n";
    // The centre runs on a radius of 10 - 4 mm: half a circle to the wall and back, turns of 2 mm, one flat.
    const auto widest = [](const motion::Program& program) {
        double most = 0;
        for (const motion::Move& move : program.moves) most = std::max(most, std::abs(move.end.tip_mm.x));
        return most;
    };
    EXPECT_NEAR(widest(conversational(described)), 6, 1e-9);
    // Nothing states it: 3 mm, or half of what is too narrow for that.
    const motion::Program assumed = conversational(after_start(bore + "M99\n"));
    EXPECT_TRUE(warns_of(assumed, 4, "nothing states the radius of tool 1: 3 mm are taken"));
    EXPECT_NEAR(widest(assumed), 7, 1e-9);
    const motion::Program narrow =
        conversational(after_start("CYCL DEF 208 BORE Q200=2 Q201=-4 Q206=90 Q334=2 Q203=0 Q335=8\nM99\n"));
    EXPECT_TRUE(warns_of(narrow, 4, "2 mm are taken"));
    EXPECT_NEAR(widest(narrow), 2, 1e-9);
}

TEST(HeidenhainLanguage, RefusesWhatHasNoPath) {
    const std::string drilling = "CYCL DEF 200 DRILLING Q200=2 Q201=-5 Q206=150 Q202=5 Q203=0\n";
    const Refusal refusals[] = {
        {after_start("L X+Q150 F100\nTCH PROBE 0.0 X\nL X+Q150\n"), 6, 4, "Q150 holds a value that only"},
        {after_start("TOOL CALL QS7 Z\n"), 4, 11, "the text QS7 is not known"},
        {after_start("SPL X+5 F100\n"), 4, 1, "SPL is not read"},
        {after_start("CYCL DEF 208 BORE Q200=2 Q201=-5 Q206=90 Q334=0 Q203=0 Q335=9\n"), 4, 1,
         "Q334 or Q335 is out of range"},
        {after_start("CYCL DEF 240 SPOT Q200=2 Q343=1 Q344=0 Q206=90 Q203=0\n"), 4, 1, "Q344 is zero"},
        {after_start("TOOL CALL 1 S0\nCYCL DEF 207 TAP Q200=2 Q201=-5 Q239=1 Q203=0\nCYCL CALL\n"), 5, 1,
         "a thread without a speed"},
        {after_start("CYCL DEF 200 DRILL Q200=PREDEF Q201=-5 Q206=90 Q203=0\n"), 4, 20,
         "no GLOBAL DEF gives it"},
        {after_start("CYCL DEF 1.0 PECKING\nCYCL CALL\n"), 4, 1, "cycle 1 lacks its depth or feed"},
        {after_start("CYCL DEF 1.2 DEPTH-5\n"), 4, 14, "has no place or no value"},
        {after_start(drilling + "CYCL CALL PAT\n"), 5, 11, "CYCL CALL PAT without a pattern"},
        {after_start("PATTERN DEF POS1 (X+5 Y+5)\nCYCL CALL PAT\n"), 5, 11, "a pattern without a cycle"},
        {after_start("PATTERN DEF STAR1 (X+5 Y+5)\n"), 4, 27, "the pattern 'STAR' is not known"},
        {after_start("PATTERN DEF ROW1 (X+5 Y+5 D5 NUM0)\n"), 4, 34, "no points, or more than 10000"},
        {after_start("PATTERN DEF POS1 (X+5 Y+5\n"), 4, 1, "a pattern has no ')'"},
        {after_start("FUNCTION MODE TURN\n"), 4, 10, "only FUNCTION MODE MILL is read"},
        {after_start("FUNCTION PARAXMODE X Y W\n"), 4, 10, "FUNCTION PARAXMODE is not read"},
        {after_start("TOOL CALL 9 Z\nL X+Q108\n"), 5, 4, "Q108 holds a value that only"},
        {after_start("L X+5 FZ0.1\n"), 4, 7, "FZ without a speed, or without the number of teeth"},
        {after_start("CC Z+5\n"), 4, 4, "a pole needs two axes"},
    };
    expect_refused_conversational(refusals);
}

TEST(Heidenhain, gives_all_refusals_at_once) {
    std::vector<Error> refusals;
    GcodeOptions options;
    options.source_name = "p.h";
    options.refusals = &refusals;
    const auto program = read_heidenhain(
        after_start(
            "3 HELLO\n4 L X+5 F100\n5 PLANE AXIAL B+45\n6 CYCL DEF 270 DATA ~\n  Q390=+1 ~\n  Q391=+2\n"
            "7 HELLO\n8 L X+1 Y+1 Z+1 FMAX\n9 L X+Q5 F100\n10 L X+2 F100\n"),
        options);
    ASSERT_FALSE(program.has_value());
    ASSERT_EQ(refusals.size(), 3U);
    EXPECT_EQ(program.error().text(), refusals[0].text());
    const int lines[] = {4, 6, 7};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(refusals[i].line, lines[i]) << refusals[i].text();
        EXPECT_FALSE(refusals[i].remedy.empty());
    }
    // What lacks a refused block is no fault of its own.
    refusals.clear();
    (void)read_heidenhain(
        after_start("3 CYCL DEF 203 DRILL ~\n  Q200=+1\n4 L X+1 Y+1 FMAX M99\n5 L X+2 RL F100\n"
                    "6 HELLO\n7 L X+3 Y+1 Z+1 FMAX\n8 CR X+5 Y+3 R+3 DR+ F100\n9 L Y+9\n"),
        options);
    ASSERT_EQ(refusals.size(), 2U);
    EXPECT_EQ(refusals[1].line, 8);
    refusals.clear();
    EXPECT_TRUE(read_heidenhain(after_start("3 L X+5 F100\n"), options).has_value());
    EXPECT_TRUE(refusals.empty());
}

TEST(Heidenhain, leaves_out_moves_that_begin_where_only_the_machine_knows) {
    const motion::Program program = conversational(
        after_start("3 L Z-5 M91\n4 L X+5 Y+0 F100\n5 L Z+3\n6 L X+15\n7 CC X+15 Y+5\n8 C X+15 Y+10 DR+\n"));
    EXPECT_TRUE(warns_of(program, 5, "that only the machine knows since line 4 are left out (2 in all)"));
    EXPECT_NEAR(feed_mm(program), 10 + 5 * kPi, 1e-9);
}

TEST(Heidenhain, reads_what_old_controls_print_of_empty_words) {
    const motion::Program program = conversational(after_start("3 L X+10 R F100 M\n4 L Y+5 R F M\n"));
    EXPECT_NEAR(feed_mm(program), 15, 1e-12);
    EXPECT_NEAR(feed_mm(conversational(after_start("3 Q1 = 7 % 4\n4 L X+Q1 F100\n"))), 3, 1e-12);
}

}  // namespace
}  // namespace tribo::readers
