// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "readers/heidenhain/heidenhain_text.hpp"

namespace tribo::readers {
namespace {

TEST(Heidenhain, ReadsLinesStockAndToolOfAPlainProgram) {
    const motion::Program program = conversational(
        "0  BEGIN PGM PLATE MM\r\n1  BLK FORM 0.1 Z X-50 Y-40 Z-20\r\n2  BLK FORM 0.2 X+50 Y+40 Z+0\r\n"
        "3  ; a comment\r\n4  TOOL DEF 5 L+0 R+6\r\n5  TOOL CALL 5 Z S3000 F800\r\n"
        "6  L X-60 Y+0 Z+5 R0 FMAX M3\r\n7  L Z-5 F200\r\n8  L X+60 F AUTO\r\n9  L IY+10.5\r\n10 L Z+100 "
        "FMAX M30\r\n"
        "11 END PGM PLATE MM\r\n");
    EXPECT_EQ(program.dialect, "Heidenhain");
    ASSERT_TRUE(program.stock);
    EXPECT_EQ(program.stock->box_mm.min, (Vec3{-50, -40, -20}));
    EXPECT_EQ(program.stock->box_mm.max, (Vec3{50, 40, 0}));
    EXPECT_EQ(program.stock->line, 3);
    ASSERT_EQ(program.tools.size(), 1u);
    EXPECT_EQ(program.tools[0].diameter_mm, 12);
    ASSERT_EQ(program.moves.size(), 4u);
    EXPECT_EQ(program.moves[0].feed_mm_per_min, 200);
    EXPECT_EQ(program.moves[1].feed_mm_per_min, 800);
    EXPECT_EQ(program.moves[1].line, 9);
    EXPECT_EQ(program.moves[1].tool, 5);
    EXPECT_EQ(program.moves[1].spindle_rpm, 3000);
    expect_near(program.moves[2].end.tip_mm, {60, 10.5, -5});
    EXPECT_EQ(program.moves[3].kind, motion::MoveKind::rapid);
    EXPECT_TRUE(program.warnings.empty());
}

TEST(Heidenhain, CountsInches) {
    const motion::Program program =
        conversational("0 BEGIN PGM P INCH\n1 L X+0 Y+0 Z+1 FMAX M3\n2 L X+1,5 F10\n3 END PGM P INCH\n");
    ASSERT_EQ(program.moves.size(), 1u);
    expect_near(program.moves[0].end.tip_mm, {38.1, 0, 25.4});
    EXPECT_NEAR(program.moves[0].feed_mm_per_min, 25.4, 1e-12);  // F counts tenths of inches
    // So do feeds of TOOL CALL and of cycles; a feed per turn does not.
    const motion::Program others = conversational(
        "0 BEGIN PGM P INCH\n1 TOOL CALL 1 Z S100 F200\n2 L X+0 Y+0 Z+1 FMAX M3\n3 L X+1\n4 L X+2 FU0.01\n"
        "5 CYCL DEF 200 Q200=0.1 Q201=-0.5 Q206=150 Q202=1 Q203=0 Q204=0.5\n6 L X+3 FMAX M99\n7 END PGM P "
        "INCH\n");
    std::vector<double> feeds;
    for (const motion::Move& move : others.moves)
        if (move.kind == motion::MoveKind::feed) feeds.push_back(move.feed_mm_per_min);
    ASSERT_EQ(feeds.size(), 3u);
    EXPECT_NEAR(feeds[0], 200 * 2.54, 1e-9);
    EXPECT_NEAR(feeds[1], 0.01 * 25.4 * 100, 1e-9);
    EXPECT_NEAR(feeds[2], 150 * 2.54, 1e-9);
}

TEST(Heidenhain, ReadsMovesAlongAxesWithoutL) {
    const motion::Program program =
        conversational(after_start("3 X+50 R+ F500\n4 IY-5\n5 Z-2 R0 F200\n6 B+0\n7 X+50\n"));
    ASSERT_FALSE(program.moves.empty());
    EXPECT_NEAR(feed_mm(program), 50 + 5 + 12, 1e-9);
    EXPECT_TRUE(warns_of(program, 4, "R+ and R- lengthen"));
    expect_near(program.moves.back().end.tip_mm, {50, -5, -2});
}

TEST(Heidenhain, TurnsByDrWhereIpaLeadsToTheSamePlace) {
    const motion::Program program = conversational(
        after_start("3 L X+10 F100\n4 CC X+0 Y+0\n5 CP IPA+360 IZ-4 DR-\n6 CP IPA+180 DR-\n7 CP DR+\n"));
    ASSERT_GE(program.moves.size(), 3u);
    const std::size_t last = program.moves.size() - 1;
    EXPECT_NEAR(motion::path_length_mm(program.moves[last - 2]), std::hypot(20 * kPi, 4), 1e-9);
    EXPECT_NEAR(program.moves[last - 2].arc->normal.z, -1, 1e-12);
    EXPECT_NEAR(motion::path_length_mm(program.moves[last - 1]), 10 * kPi, 1e-9);
    expect_near(program.moves[last - 1].end.tip_mm, {-10, 0, program.moves[last - 2].end.tip_mm.z}, 1e-9);
    EXPECT_NEAR(motion::path_length_mm(program.moves[last]), 20 * kPi, 1e-9);
    EXPECT_NEAR(program.moves[last].arc->normal.z, 1, 1e-12);
    EXPECT_TRUE(warns_of(program, 6, "DR counts") || warns_of(program, 7, "DR counts"));
}

TEST(Heidenhain, TurnsCirclesOfEveryKind) {
    const motion::Program program = conversational(after_start(R"(3 L X+10 F500
4 CC X+0 Y+0
5 C X+0 Y+10 DR+
6 C X+0 Y+10 DR-
7 CR X-10 Y+0 R+10 DR+
8 CR X+10 Y+0 R-20 DR-
9 CP IPA+720 IZ-8 DR+
10 LP PR+20 PA+90
11 CP PA+0 DR-
12 L IY-10
13 CT X+30 Y-20
)"));
    ASSERT_EQ(program.moves.size(), 10u);
    const auto length = [&](std::size_t i) { return path_length_mm(program.moves[i]); };
    EXPECT_NEAR(length(1), 10 * kPi / 2, 1e-9);
    EXPECT_NEAR(length(2), 20 * kPi, 1e-9);  // a full circle
    EXPECT_NEAR(length(3), 10 * kPi / 2, 1e-9);
    // Radius 20 over a chord of 20: the long way, 300 degrees.
    EXPECT_NEAR(length(4), 20 * 300 * kPi / 180, 1e-9);
    EXPECT_NEAR(length(5), std::hypot(2 * 20 * kPi, 8), 1e-9);
    expect_near(program.moves[5].end.tip_mm, {10, 0, 2}, 1e-9);
    expect_near(program.moves[6].end.tip_mm, {0, 20, 2}, 1e-9);
    EXPECT_NEAR(length(7), 20 * kPi / 2, 1e-9);
    expect_near(program.moves[8].end.tip_mm, {20, -10, 2}, 1e-9);
    // Down along -y, then tangentially to (30, -20): a quarter of radius 10.
    EXPECT_NEAR(length(9), 10 * kPi / 2, 1e-9);
    expect_near(pose_at(program.moves[9], 0.5).tip_mm,
                {30 - 10 * std::sqrt(0.5), -10 - 10 * std::sqrt(0.5), 2}, 1e-9);
}

TEST(Heidenhain, ComputesWithParameters) {
    const auto x_of = [](const std::string& text) {
        const motion::Program program = conversational(after_start(text + "L X+Q1 F100\n"));
        return program.moves.empty() ? NAN : program.moves.back().end.tip_mm.x;
    };
    EXPECT_DOUBLE_EQ(x_of("FN 0: Q1 = +5\n"), 5);
    EXPECT_DOUBLE_EQ(x_of("FN 0: Q2 = -4\nFN 1: Q1 = +Q2 + +5\n"), 1);
    EXPECT_DOUBLE_EQ(x_of("FN 2: Q1 = +10 - +Q9\n"), 10);
    EXPECT_DOUBLE_EQ(x_of("FN 3: Q1 = +3 * +7\n"), 21);
    EXPECT_DOUBLE_EQ(x_of("FN 4: Q1 = +4 DIV +8\n"), 0.5);
    EXPECT_DOUBLE_EQ(x_of("FN 5: Q1 = SQRT +16\n"), 4);
    EXPECT_NEAR(x_of("FN 6: Q1 = SIN +30\n"), 0.5, 1e-15);
    EXPECT_DOUBLE_EQ(x_of("FN 8: Q1 = +3 LEN +4\n"), 5);
    EXPECT_DOUBLE_EQ(x_of("FN 13: Q1 = +1 ANG +1\n"), 45);
    EXPECT_NEAR(x_of("Q2 = 3\nQ1 = 2 * ( Q2 + 1 ) ^ 2 - SQ 2 / 4\n"), 31, 1e-12);
    EXPECT_NEAR(x_of("Q1 = ABS ( -2 ) * COS 60 + INT 3.7 + FRAC 0.25 + NEG 1 + SGN -4\n"), 2.25, 1e-12);
    EXPECT_NEAR(x_of("Q1 = PI\n"), kPi, 1e-15);
}

TEST(Heidenhain, RunsLabelsRepeatsAndJumps) {
    // A subprogram behind M30, called twice; a repeat that runs three times in all; a loop with FN 12.
    const motion::Program program = conversational(after_start(R"(3 CALL LBL 1
4 CALL LBL "SIDE"
5 LBL 2
6 L IX+1 F100
7 CALL LBL 2 REP 2
8 Q5 = 0
9 LBL 3
10 L IZ+1
11 Q5 = Q5 + 1
12 FN 12: IF +Q5 LT +4 GOTO LBL 3
13 L Z+50 FMAX M30
14 LBL 1
15 L Y+5 F100
16 LBL 0
17 LBL "SIDE"
18 L IY+5
19 LBL 0
)"));
    ASSERT_EQ(program.moves.size(), 2u + 3 + 4 + 1);
    expect_near(program.moves[program.moves.size() - 2].end.tip_mm, {3, 10, 14});
}

TEST(Heidenhain, CallsOnceByRepWithoutANumber) {
    const motion::Program program =
        conversational(after_start("3 CALL LBL 1 REP\n4 STOP M30\n5 LBL 1\n6 L IX+4 F100\n7 LBL 0\n"));
    EXPECT_NEAR(feed_mm(program), 4, 1e-12);
}

TEST(Heidenhain, RepeatsAsOftenAsAParameterBehindRepSays) {
    for (const char* count : {"REPQ9", "REP Q9", "REP+Q9", "REP 3", "REP3/3", "REP 3/1"}) {
        const motion::Program program = conversational(
            after_start("3 Q9 = 3\n4 LBL 1\n5 L IX+2 F100\n6 CALL LBL 1 " + std::string(count) + "\n"));
        EXPECT_NEAR(feed_mm(program), 4 * 2, 1e-12) << count;
    }
    for (const char* rest : {"REPX", "FOO", "REP 2 FOO", "REP Q9 Q8", "5"}) {
        const auto program = read_heidenhain(
            after_start("3 Q9 = 3\n4 LBL 1\n5 L IX+2 F100\n6 CALL LBL 1 " + std::string(rest) + "\n"), {});
        ASSERT_FALSE(program.has_value()) << rest;
        EXPECT_EQ(program.error().cause, "this does not belong behind CALL LBL") << rest;
    }
}

TEST(Heidenhain, CallsTheToolOfAParameter) {
    const motion::Program program =
        conversational(after_start("3 Q11 = 32\n4 TOOL CALL Q11 Z S900 F200\n5 L X+5 F AUTO\n"));
    EXPECT_EQ(program.moves.back().tool, 32);
    EXPECT_EQ(program.moves.back().feed_mm_per_min, 200);
    EXPECT_FALSE(read_heidenhain(after_start("3 Q11 = -2\n4 TOOL CALL Q11 Z\n5 L X+5 F100\n"), {}));
}

TEST(Heidenhain, RefusesADatumThatIsNoNumber) {
    for (const char* shift : {"Xnan", "Xabc", "X", "DATUM"}) {
        const auto program = read_heidenhain(after_start("3 CYCL DEF 7.0 ZERO POINT\n4 CYCL DEF 7.1 " +
                                                         std::string(shift) + "\n5 L X+5 F100\n"),
                                             {});
        ASSERT_FALSE(program.has_value()) << shift;
        EXPECT_NE(program.error().cause.find("with a number"), std::string::npos) << shift;
    }
}

TEST(Heidenhain, SaysThatAParameterHasNoValue) {
    const motion::Program program =
        conversational(after_start("3 L X+Q55 F100\n4 Q56 = Q57 + 1\n5 L X+Q56\n6 L X+Q55\n"));
    EXPECT_TRUE(warns_of(program, 4, "Q55 has no value so far: 0 is taken"));
    EXPECT_TRUE(warns_of(program, 5, "Q57 has no value so far"));
    EXPECT_FALSE(warns_of(program, 6, "has no value"));
    EXPECT_FALSE(warns_of(program, 7, "has no value"));
}

TEST(Heidenhain, TakesTheFeedBehindM128ForThatOfTheRotaryAxes) {
    const motion::Program program =
        conversational(after_start("3 L X+1 F300\n4 L M128 F5000\n5 L X+5\n6 L X+9 F200 M128 FQ8\n"));
    ASSERT_GE(program.moves.size(), 3u);
    const std::size_t last = program.moves.size() - 1;
    EXPECT_EQ(program.moves[last - 1].feed_mm_per_min, 300);
    EXPECT_EQ(program.moves[last].feed_mm_per_min, 200);
}

TEST(Heidenhain, TakesTheFeedsOfM140AndM103ForTheirOwn) {
    const motion::Program program = conversational(after_start(
        "3 L Z+0 F300\n4 L X+0 Y+38.5 F125 M140 MB50 F750\n5 L Z+0\n6 L X+1 F500 M103 F20\n7 L X+2\n"));
    std::vector<double> feeds;
    for (const motion::Move& move : program.moves)
        if (move.kind == motion::MoveKind::feed) feeds.push_back(move.feed_mm_per_min);
    EXPECT_EQ(feeds, (std::vector<double>{300, 125, 750, 125, 500, 500}));
}

TEST(Heidenhain, CirclesRiseByTheirLinearPart) {
    const std::pair<const char*, double> circles[] = {{"CC X+0 Y+10\nC X+10 Y+10 DR+ LIN_Z-6", 6},
                                                      {"CR X+10 Y+10 R+10 LIN_Z-6 DR+", 6},
                                                      {"CR X+10 Y+10 R+10 LIN_IZ-11 DR+", 11}};
    for (const auto& [circle, rise] : circles) {
        const motion::Program program =
            conversational(after_start("3 L X+0 Y+0 F100\n4 L Z+0\n" + std::string(circle) + "\n"));
        ASSERT_FALSE(program.moves.empty()) << circle;
        EXPECT_NEAR(motion::path_length_mm(program.moves.back()), std::hypot(5 * kPi, rise), 1e-9) << circle;
    }
}

TEST(Heidenhain, LeavesOutAFirstMoveFromAnywhere) {
    const motion::Program program = conversational(
        "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S5000\n2 L X-100 Y-100 Z150 R0 F13500 M3\n3 L Z+2 R0 F1000\n"
        "4 END PGM A MM\n");
    ASSERT_EQ(program.moves.size(), 1u);
    expect_near(program.moves[0].start.tip_mm, {-100, -100, 150});
    EXPECT_TRUE(warns_of(program, 3, "are left out (1 in all)"));
}

TEST(Heidenhain, DrillsWithCycle200) {
    const motion::Program program = conversational(after_start(R"(3 CYCL DEF 200 DRILLING ~
    Q200=2    ;SET-UP CLEARANCE ~
    Q201=-15  ;DEPTH ~
    Q206=150  ;FEED RATE FOR PLNGNG ~
    Q202=6    ;PLUNGING DEPTH ~
    Q210=0.5  ;DWELL TIME AT TOP ~
    Q203=-1   ;SURFACE COORDINATE ~
    Q204=50   ;2ND SET-UP CLEARANCE ~
    Q211=0.25 ;DWELL TIME AT DEPTH
4 L X+10 Y+5 R0 FMAX M99
5 L X+20 R0 FMAX
6 CYCL CALL
)"));
    double feed_path = 0, dwell = 0, deepest = 0;
    for (const motion::Move& m : program.moves) {
        if (m.kind == motion::MoveKind::feed) {
            EXPECT_EQ(m.feed_mm_per_min, 150);
            feed_path += path_length_mm(m);
        }
        dwell += m.kind == motion::MoveKind::dwell ? m.duration_s : 0;
        deepest = std::min(deepest, m.end.tip_mm.z);
    }
    EXPECT_NEAR(deepest, -16, 1e-12);
    // Three infeeds: 2 + 6, from the clearance above the last depth 2 + 6, then 2 + 3; two holes.
    EXPECT_NEAR(feed_path, 2 * (8 + 8 + 5), 1e-9);
    EXPECT_NEAR(dwell, 2 * (2 * 0.5 + 0.25), 1e-12);
    expect_near(program.moves.back().end.tip_mm, {20, 5, 49});
    EXPECT_EQ(program.moves.back().kind, motion::MoveKind::rapid);
}

TEST(Heidenhain, BreaksChipsInCycle203AndReamsWith201) {
    const motion::Program deep = conversational(after_start(R"(CYCL DEF 203 UNIVERSAL DRILLING ~
Q200=2 ~
Q201=-10 ~
Q206=FAUTO ~
Q202=4 ~
Q210=0 ~
Q203=+0 ~
Q204=2 ~
Q212=1 ~
Q213=3 ~
Q205=1 ~
Q211=0 ~
Q208=1000 ~
Q256=0.5
CYCL CALL M3
)"));
    // 4, 3, 2, 1: depths 4, 7, 9, 10 with three chips broken by half a millimetre.
    std::vector<double> z;
    for (const motion::Move& m : deep.moves) z.push_back(m.end.tip_mm.z);
    EXPECT_EQ(z, (std::vector<double>{2, -4, -3.5, -7, -6.5, -9, -8.5, -10, 2}));
    EXPECT_EQ(deep.moves[1].feed_mm_per_min, 500);
    EXPECT_EQ(deep.moves[2].feed_mm_per_min, 1000);

    const motion::Program reamed = conversational(after_start(R"(CYCL DEF 201 REAMING ~
Q200=2 ~
Q201=-10 ~
Q206=100 ~
Q211=0 ~
Q208=0 ~
Q203=+0 ~
Q204=20
CYCL CALL POS X+5 Y+5 Z+3 FMAX
)"));
    z.clear();
    for (const motion::Move& m : reamed.moves) z.push_back(m.end.tip_mm.z);
    EXPECT_EQ(z, (std::vector<double>{3, 2, -10, 2, 20}));
    EXPECT_EQ(reamed.moves[3].feed_mm_per_min, 100);
}

TEST(Heidenhain, BoresBackFromBelowInCycle204) {
    // The edge lies 15 mm above the end of the bar. It starts 2 mm below the underside at Z-20, and cuts 5 mm
    // upwards.
    const std::string cycle =
        "3 CYCL DEF 204 BACK BORING Q200=2 Q249=+5 Q250=20 Q251=3.5 Q252=15 Q253=750 Q254=200 Q255=1 Q203=+0 "
        "Q204=50 Q336=0 ";
    const struct {
        const char* direction;
        Vec3 aside;
    } cases[] = {
        {"Q214=1", {-3.5, 0, 0}}, {"Q214=2", {0, -3.5, 0}}, {"Q214=3", {3.5, 0, 0}}, {"Q214=4", {0, 3.5, 0}}};
    for (const auto& c : cases) {
        const motion::Program program =
            conversational(after_start(cycle + c.direction + "\n4 L X+20 Y+30 R0 FMAX M99\n"));
        EXPECT_TRUE(warns_of(program, 4, "a spindle that stands"));
        EXPECT_EQ(heights(program), (std::vector<double>{10, 2, 2, -37, -37, -30, -37, -37, 2, 2, 50}))
            << c.direction;
        expect_near(program.moves[2].end.tip_mm, Vec3{20, 30, 2} + c.aside);
        expect_near(program.moves[3].end.tip_mm, Vec3{20, 30, -37} + c.aside);
        expect_near(program.moves[5].end.tip_mm, {20, 30, -30});
        EXPECT_EQ(program.moves[3].feed_mm_per_min, 750);
        EXPECT_EQ(program.moves[5].feed_mm_per_min, 200);
        EXPECT_NEAR(feed_mm(program), 4 * 3.5 + 2 * 39 + 7 + 7, 1e-9);
        expect_near(program.moves.back().end.tip_mm, {20, 30, 50});
    }
    EXPECT_NE(fault(after_start(cycle + "Q214=0\n")).find("no direction to step aside"), std::string::npos);
    EXPECT_NE(
        fault(after_start("3 CYCL DEF 204 Q200=2 Q249=-5 Q250=20 Q251=3 Q252=15 Q254=200 Q203=0 Q214=1\n"))
            .find("Q249"),
        std::string::npos);
}

TEST(Heidenhain, ShiftsAndTurnsTheDatum) {
    const motion::Program program = conversational(after_start(R"(3 CYCL DEF 7.0 DATUM SHIFT
4 CYCL DEF 7.1 X+10
5 CYCL DEF 7.2 Y+20
6 CYCL DEF 10.0 ROTATION
7 CYCL DEF 10.1 ROT+90
8 L X+5 Y+0 F100
9 TRANS DATUM RESET
10 CYCL DEF 10.1 ROT+0
11 L X+5 Y+0
)"));
    expect_near(program.moves[0].end.tip_mm, {10, 25, 10}, 1e-12);
    expect_near(program.moves[1].end.tip_mm, {5, 0, 10}, 1e-12);
}

TEST(Heidenhain, TiltsThePlaneWithoutKnowingTheMachine) {
    const motion::Program program = conversational(after_start(R"(3 CYCL DEF 7.1 Z-5
4 PLANE SPATIAL SPA+0 SPB+90 SPC+0 STAY
5 L X+0 Y+0 Z+20 R0 FMAX
6 L Z+1 F100
7 CC X+0 Y+0
8 L X+3
9 C X+3 DR+
10 PLANE RESET STAY
11 L X+0 Y+0 Z+0 R0 FMAX
12 L X+1 F100
)"));
    EXPECT_FALSE(program.has_rotary_words);
    // SPB90 turns x to -z and z to +x.
    ASSERT_EQ(program.moves.size(), 4u);
    expect_near(program.moves[0].start.tip_mm, {20, 0, -5}, 1e-12);
    expect_near(program.moves[0].end.axis, {1, 0, 0}, 1e-12);
    expect_near(program.moves[1].end.tip_mm, {1, 0, -8}, 1e-12);
    EXPECT_NEAR(path_length_mm(program.moves[2]), 6 * kPi, 1e-9);
    expect_near(pose_at(program.moves[2], 0.25).tip_mm, {1, 3, -5}, 1e-9);
    expect_near(program.moves[3].end.axis, {0, 0, 1}, 1e-12);
    expect_near(program.moves[3].end.tip_mm, {1, 0, -5}, 1e-12);
}

TEST(Heidenhain, HoldsTheTipWithM128AndTcpmOnAMachine) {
    for (const char* control : {"M128", "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS"}) {
        const motion::Program program = on("xyzac-trt", after_start(std::string("3 ") + control + R"(
4 L X+10 A+30 C+90 F600
5 FUNCTION RESET TCPM
6 L IZ+5
)"));
        ASSERT_GE(program.moves.size(), 2u);
        const motion::Move& last = program.moves.back();
        expect_near(last.start.tip_mm, {10, 0, 10}, 1e-9);
        // Table A30 C90: the tool leans to +x of the part.
        expect_near(last.start.axis, {0.5, 0, std::sqrt(0.75)}, 1e-12);
        expect_near(last.end.tip_mm, Vec3{10, 0, 10} + 5 * last.start.axis, 1e-9);
        EXPECT_NEAR(feed_mm(program), 15, 1e-9) << control;
    }
}

TEST(Heidenhain, LeadsTheToolAlongVectorsWithAndWithoutAMachine) {
    const std::string text =
        after_start("3 LN X+5 Y+0 Z+10 TX+0 TY+0.6 TZ+0.8 F500\n4 LN X+9 TX+0 TY+0 TZ+1\n");
    const motion::Program plain = conversational(text), table = on("xyzbc-trt", text);
    ASSERT_EQ(plain.moves.size(), 2u);
    expect_near(plain.moves[0].end.axis, {0, 0.6, 0.8}, 1e-12);
    expect_near(plain.moves[1].end.axis, {0, 0, 1}, 1e-12);
    EXPECT_FALSE(plain.has_rotary_words);
    EXPECT_NEAR(feed_mm(table), feed_mm(plain), 1e-9);
    expect_near(table.moves.back().end.axis, {0, 0, 1}, 1e-9);
}

TEST(Heidenhain, NotesRotaryWordsWithoutAMachine) {
    const motion::Program program = conversational(after_start("3 L A+10 C+20 FMAX\n4 L X+5 F100 M128\n"));
    EXPECT_TRUE(program.has_rotary_words);
    EXPECT_FALSE(conversational(after_start("3 L A+0 C+0 FMAX\n4 L X+5 F100\n")).has_rotary_words);
    EXPECT_EQ(program.first_rotary_line, 4);
    EXPECT_TRUE(warns_of(program, 4, "without a machine"));
}

TEST(Heidenhain, RefusesWithPlaceCauseAndRemedy) {
    const struct {
        const char* text;
        const char* message;
    } cases[] = {
        {"3 L X+10\n", ""},
        {"3 L X+10 R+5 F100\n", "p.h:4:10: error: R with a number is no radius compensation"},
        {"3 L X+1e F100\n", "p.h:4:8: error: 'E' does not belong into a block L"},
        {"3 C X+1 Y+1 DR+\n", "p.h:4:5: error: a circle without a centre"},
        {"3 CC X+5 Y+0\n4 C X+5 Y+9\n", "p.h:5:5: error: a circle without DR+ or DR-"},
        {"3 CC X+5 Y+0\n4 C X+5 Y+9 DR+\n", "p.h:5:5: error: the arc's radius is 5 mm at its start and 9 mm"},
        {"3 CR X+100 Y+0 R+10 DR+\n", "p.h:4:6: error: radius 10 mm cannot reach the end"},
        {"3 CT X+10 Y+10\n", ""},
        {"3 L X+5 F100\n4 CT X+10\n", "p.h:5:6: error: the end of CT lies straight ahead"},
        {"3 CALL LBL 7\n", "p.h:4:8: error: there is no LBL 7"},
        {"3 CALL OTHER\n", "p.h:4:8: error: only CALL LBL and CALL PGM are read"},
        {"3 RND R5\n", "p.h:4:7: error: RND without a path function before it"},
        {"3 CYCL CALL\n", "p.h:4:12: error: a cycle is called, but none is defined"},
        {"3 CYCL DEF 224 PATTERN\n", "p.h:4:12: error: cycle 224 is not read yet"},
        {"3 CYCL DEF 200 DRILLING ~\nQ200=2 ~\nQ201=-5 ~\nQ206=100\n",
         "p.h:4:3: error: cycle 200 lacks Q203"},
        {"3 CYCL DEF 200 DRILLING Q200=2 Q201=5 Q206=100 Q203=0\n", "the depth Q201 is not below zero"},
        {"3 FN 4: Q1 = +5 DIV +0\n", "p.h:4:17: error: division by zero"},
        {"3 FN 18: SYSREAD Q1 = ID1\n4 L X+Q1 F100\n",
         "p.h:5:6: error: Q1 holds a value that only the machine knows"},
        {"3 FN 39: X\n", "p.h:4:6: error: FN 39 is not read"},
        {"3 Q1 = SQRT -1\n", "p.h:4:8: error: SQRT has no value here"},
        {"3 Q1 = ( 2 + 3\n", "a ')' is missing"},
        {"3 Q1 = 2 +\n", "a number is missing"},
        {"3 Q2000 = 2\n", "there is no parameter beyond Q1999"},
        {"3 QL500 = 2\n", "there is no parameter beyond QL499"},
        {"3 LBL 1\n4 FN 9: IF +1 EQU +1 GOTO LBL 1\n", "does not seem to end"},
        {"3 LBL 1\n4 CALL LBL 1\n", "subprograms are nested too deeply"},
        {"3 HELLO\n", "p.h:4:3: error: the block 'HELLO' is not known"},
        {"3 PLANE AXIAL B+45\n",
         "p.h:4:9: error: PLANE AXIAL turns the axes of a machine, and none is named"},
        {"3 TOOL CALL 1 Y\n", "a tool along Y is not read"},
        {"3 BLK FORM 0.2 X+1 Y+1 Z+1\n", "BLK FORM 0.2 without 0.1"},
        {"3 L X+2000000 F100\n", "the coordinate of 2000000 mm is out of range"},
        {"3 L X+5 F-3\n", "p.h:4:9: error: the feed of -3 mm/min is out of range"},
    };
    for (const auto& c : cases) {
        const std::string text = after_start(c.text), message = fault(text);
        if (*c.message == '\0') continue;
        EXPECT_NE(message.find(c.message), std::string::npos) << c.text << "gave: " << message;
        EXPECT_NE(message.find("; "), std::string::npos) << message;
    }
    EXPECT_NE(fault("").find("no conversational program"), std::string::npos);
}

TEST(Heidenhain, RefusesLoopsOfLinesThatDoNothing) {
    std::string comments, joined = "3 LBL 1\n4 CYCL DEF 247 ~\n";
    for (int i = 0; i < 50'000; ++i) {
        comments += "; nothing\n";
        joined += "Q339=+1 ~\n";
    }
    const std::string again = "9 FN 9: IF +1 EQU +1 GOTO LBL 1\n";
    for (const std::string& text : {"3 LBL 1\n" + comments + again, joined + "Q339=+1\n" + again}) {
        const auto program = read_heidenhain(after_start(text), {});
        ASSERT_FALSE(program.has_value());
        EXPECT_NE(program.error().cause.find("have run without a move"), std::string::npos)
            << program.error().text();
        EXPECT_GT(program.error().line, 3);
    }
    EXPECT_TRUE(read_heidenhain(after_start(comments), {}).has_value());
}

TEST(Heidenhain, DeclaresAToolOncePerLine) {
    const motion::Program program =
        conversational(after_start("3 LBL 1\n4 TOOL DEF 5 L+40 R+6\n5 CALL LBL 1 REP 20\n"));
    ASSERT_EQ(program.tools.size(), 1U);
    EXPECT_EQ(program.tools[0].length_mm, 40);
}

}  // namespace
}  // namespace tribo::readers
