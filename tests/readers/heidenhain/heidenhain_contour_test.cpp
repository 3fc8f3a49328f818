// SPDX-License-Identifier: MIT
// Contours: radius compensation, RND, CHF, APPR, DEP; circles in every plane; mirror and scale.
#include <cmath>
#include <gtest/gtest.h>

#include "readers/heidenhain/heidenhain_text.hpp"

namespace tribo::readers {
namespace {

// A tool of radius 5 beside the corner of a square of 50 mm.
std::string with_cutter(std::string_view text) {
    return "0 BEGIN PGM P MM\n1 TOOL DEF 1 L+0 R+5\n2 TOOL CALL 1 Z S2000 F500\n"
           "3 L X-20 Y-20 Z+0 R0 FMAX M3\n" +
           std::string(text) + "99 END PGM P MM\n";
}

constexpr std::string_view kSquare = "L Y+50\nL X+50\nL Y+0\nL X+0\nL X-20 Y-20 R0 FMAX\n";

TEST(HeidenhainContour, KeepsTheCutterOutsideOfASquare) {
    const motion::Program program = conversational(with_cutter("L X+0 Y+0 RL F200\n" + std::string(kSquare)));
    // The way in, four sides with three rounded corners between them, the way out.
    ASSERT_EQ(program.moves.size(), 9U);
    expect_near(program.moves[0].end.tip_mm, {-5, 0, 0}, 1e-12);
    expect_near(program.moves[1].end.tip_mm, {-5, 50, 0}, 1e-12);
    expect_near(pose_at(program.moves[2], 0.5).tip_mm, {-5 * std::sqrt(0.5), 50 + 5 * std::sqrt(0.5), 0},
                1e-9);
    for (const std::size_t corner : {2U, 4U, 6U}) EXPECT_NEAR(length_of(program, corner), 2.5 * kPi, 1e-9);
    for (const std::size_t side : {1U, 3U, 5U, 7U}) EXPECT_NEAR(length_of(program, side), 50, 1e-9);
    expect_near(program.moves[7].end.tip_mm, {0, -5, 0}, 1e-12);
    expect_near(program.moves[8].end.tip_mm, {-20, -20, 0}, 1e-12);
    EXPECT_EQ(program.moves[8].kind, motion::MoveKind::rapid);
    EXPECT_EQ(program.moves[7].feed_mm_per_min, 200);
}

TEST(HeidenhainContour, EndsInsideCornersWhereTheOffsetsMeet) {
    const motion::Program program = conversational(with_cutter("L X+0 Y+0 RR F200\n" + std::string(kSquare)));
    ASSERT_EQ(program.moves.size(), 6U);
    const double sides[] = {45, 40, 40, 45};
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(length_of(program, k + 1), sides[k], 1e-9);
    expect_near(program.moves[1].end.tip_mm, {5, 45, 0}, 1e-9);
    expect_near(program.moves[4].end.tip_mm, {0, 5, 0}, 1e-9);
}

TEST(HeidenhainContour, CountsTheOversizeAndStaysBesideTheContourInARetract) {
    const motion::Program program = conversational(
        "0 BEGIN PGM P MM\n1 TOOL DEF 1 L+0 R+5\n2 TOOL CALL 1 Z S2000 F500 DR+1\n"
        "3 L X-20 Y-20 Z+0 R0 FMAX M3\n4 L X+0 Y+0 RL\n5 L Y+50\n6 L Z+30 R0 FMAX\n7 L X-20\n");
    ASSERT_EQ(program.moves.size(), 4U);
    expect_near(program.moves[1].end.tip_mm, {-6, 50, 0}, 1e-12);
    expect_near(program.moves[2].end.tip_mm, {-6, 50, 30}, 1e-12);
    expect_near(program.moves[3].end.tip_mm, {-20, 50, 30}, 1e-12);
}

TEST(HeidenhainContour, TakesTheProgrammedPathWhereNothingStatesTheRadius) {
    const motion::Program program = conversational(after_start("3 L X+10 Y+0 RL\n4 L Y+50\n5 L X+0 R0\n"));
    ASSERT_EQ(program.moves.size(), 3U);
    expect_near(program.moves[1].end.tip_mm, {10, 50, 10}, 1e-12);
    EXPECT_TRUE(warns_of(program, 4, "nothing states the radius of tool 1"));
}

TEST(HeidenhainContour, TakesTheRadiusFromAComment) {
    const motion::Program program = conversational(
        after_start("; T1 D=10 CR=0 - flat end mill\n3 L X+10 Y+0 RL\n4 L Y+50\n5 L X+0 R0\n"));
    ASSERT_EQ(program.moves.size(), 3U);
    expect_near(program.moves[1].end.tip_mm, {5, 50, 10}, 1e-12);
}

TEST(HeidenhainContour, RoundsAndChamfersCorners) {
    for (const auto& [corner, between] : {std::pair{"RND R5 F50", 2.5 * kPi}, {"CHF 5", std::sqrt(50.0)}}) {
        const motion::Program program =
            conversational(after_start("3 L X+20 F100\n4 " + std::string(corner) + "\n5 L Y+20\n6 L X+0\n"));
        ASSERT_EQ(program.moves.size(), 4U) << corner;
        EXPECT_NEAR(length_of(program, 0), 15, 1e-9);
        EXPECT_NEAR(length_of(program, 1), between, 1e-9);
        EXPECT_NEAR(length_of(program, 2), 15, 1e-9);
        expect_near(program.moves[1].end.tip_mm, {20, 5, 10}, 1e-9);
        EXPECT_EQ(program.moves[1].feed_mm_per_min, corner[0] == 'R' ? 50 : 100);
        EXPECT_EQ(program.moves[2].feed_mm_per_min, 100);
    }
    // Between a line and a circle of radius 20 about (0, 0): the middle of the rounding is 5 below the line
    // and 15 from the circle's.
    const motion::Program round =
        conversational(after_start("3 L X-40 Y+10 F100\n4 L X+17.320508075688775\n5 RND R5\n6 CC X+0 Y+0\n"
                                   "7 C X+20 Y+0 DR-\n"));
    ASSERT_EQ(round.moves.size(), 4U);
    expect_near(round.moves[1].end.tip_mm, {std::sqrt(15 * 15 - 25.0), 10, 10}, 1e-6);
    expect_near(round.moves[2].arc->centre_mm, {std::sqrt(15 * 15 - 25.0), 5, 10}, 1e-6);
}

TEST(HeidenhainContour, ApproachesAndDepartsInEveryShape) {
    const struct {
        const char* approach;
        Vec3 begin;  // auxiliary point
        double length;
    } ways[] = {
        {"APPR LT X+0 Y+0 LEN10 RL F100", {0, -10, 0}, 10},
        {"APPR LN X+0 Y+0 LEN10 RL F100", {-10, 0, 0}, 10},
        {"APPR CT X+0 Y+0 CCA90 R+5 RL F100", {-5, -5, 0}, 2.5 * kPi},
        {"APPR CT X+0 Y+0 CCA90 R+5 RR F100", {5, -5, 0}, 2.5 * kPi},
        {"APPR LCT X+0 Y+0 R5 RL F100", {-5, -5, 0}, 2.5 * kPi},
    };
    for (const auto& way : ways) {
        const motion::Program program = conversational(
            "BEGIN PGM P MM\nTOOL DEF 1 L+0 R+0\nTOOL CALL 1 Z S2000\nL X-20 Y-5 Z+0 FMAX M3\n" +
            std::string(way.approach) + "\nL Y+20\nDEP LT LEN7\n");
        ASSERT_EQ(program.moves.size(), 4U) << way.approach;
        expect_near(program.moves[0].end.tip_mm, way.begin, 1e-9);
        EXPECT_NEAR(length_of(program, 1), way.length, 1e-9) << way.approach;
        expect_near(program.moves[1].end.tip_mm, {0, 0, 0}, 1e-9);
        expect_near(program.moves[3].end.tip_mm, {0, 27, 0}, 1e-9);
    }
    const struct {
        const char* departure;
        Vec3 end;
        double length;
    } ends[] = {
        {"DEP LN LEN+10", {-15, 50, 0}, 10},
        {"DEP CT CCA90 R+5", {-10, 55, 0}, 2.5 * kPi},
        {"DEP LCT X-30 Y+55 Z+20 R+5", {-30, 55, 20}, 2.5 * kPi + 20 + 20},
        {"CC X-30 Y+0\nDEP PLCT PR+55 PA+90 R+5", {-30, 55, 0}, 2.5 * kPi + 20},
    };
    for (const auto& end : ends) {
        const motion::Program program = conversational(
            with_cutter("APPR LT X+0 Y+0 LEN10 RL F100\nL Y+50\n" + std::string(end.departure) + "\n"));
        ASSERT_GE(program.moves.size(), 4U) << end.departure;
        expect_near(program.moves.back().end.tip_mm, end.end, 1e-9);
        double length = 0;
        for (std::size_t k = 3; k < program.moves.size(); ++k) length += length_of(program, k);
        EXPECT_NEAR(length, end.length, 1e-9) << end.departure;
    }
}

TEST(HeidenhainContour, TurnsAboutAPoleInEveryPlane) {
    const motion::Program program = conversational(after_start(R"(3 CC X+0 Z+0
4 C X+10 Z+0 DR+ F100
5 L X+0 Y+10
6 CC Y+0 Z+0
7 C Y+0 Z+10 DR+
8 LP PR+20 PA+0
)"));
    ASSERT_EQ(program.moves.size(), 4U);
    // About +y a right-handed turn leads from z to x, about +x from y to z.
    expect_near(pose_at(program.moves[0], 0.5).tip_mm, {10 * std::sqrt(0.5), 0, 10 * std::sqrt(0.5)}, 1e-9);
    expect_near(pose_at(program.moves[2], 0.5).tip_mm, {0, 10 * std::sqrt(0.5), 10 * std::sqrt(0.5)}, 1e-9);
    expect_near(program.moves[3].end.tip_mm, {0, 20, 0}, 1e-9);
}

TEST(HeidenhainContour, FindsThePlaneOfAPoleWithThreeAxes) {
    const motion::Program program = conversational(after_start(R"(3 CC X+0 Y+0 Z+0
4 C X+10 Y+0 Z+0 DR+ F100
5 L X+10 Y+10 Z+10
6 L Y+0
7 CC X+10 Y+0 Z+0
8 C Z-10 DR+
9 L Y-5
10 L Y+0
11 CC X+10 Y+0
12 C Z+10 DR+
)"));
    ASSERT_EQ(program.moves.size(), 7U);
    expect_near(pose_at(program.moves[0], 0.5).tip_mm, {10 * std::sqrt(0.5), 0, 10 * std::sqrt(0.5)}, 1e-9);
    // Start, pole and end on one line: on in the direction of the move before, about +x.
    expect_near(pose_at(program.moves[3], 0.5).tip_mm, {10, -10, 0}, 1e-9);
    expect_near(pose_at(program.moves[6], 0.5).tip_mm, {10, 10, 0}, 1e-9);  // z of the pole stays
    EXPECT_TRUE(warns_of(program, 9, "that of the move before is taken"));
}

TEST(HeidenhainContour, TakesTheHeightOfAnEarlierPoleWhereOnlyThatFits) {
    const motion::Program program = conversational(after_start(R"(3 L X+5 Y+3 Z+4 F100
4 CC X+5 Y+0 Z+0
5 C X+5 Y-3 Z+4 DR+
6 CC X+5 Y+0
7 C X+5 Y+5 Z+0 DR-
)"));
    ASSERT_EQ(program.moves.size(), 3U);
    EXPECT_NEAR(length_of(program, 2), 5 * (kPi - std::atan2(4, 3)), 1e-9);
    EXPECT_TRUE(warns_of(program, 8, "about the Z of an earlier CC"));
}

TEST(HeidenhainContour, MirrorsAndScales) {
    const motion::Program program = conversational(after_start(R"(4 CYCL DEF 8.0 MIRROR IMAGE
5 CYCL DEF 8.1 X
6 CC X+10 Y+0
7 C X+10 Y+10 DR- F100
8 CYCL DEF 8.0 MIRROR IMAGE
9 CYCL DEF 8.1
10 CYCL DEF 11.0 SCALING
11 CYCL DEF 11.1 SCL 0.5
12 L X+20 Y+20
13 CR X+40 Y+40 R+20 DR+
)"));
    ASSERT_EQ(program.moves.size(), 3U);
    expect_near(program.moves[0].end.tip_mm, {-10, 10, 10}, 1e-12);
    EXPECT_NEAR(length_of(program, 0), 5 * kPi, 1e-9);
    expect_near(program.moves[1].end.tip_mm, {10, 10, 10}, 1e-12);
    EXPECT_NEAR(length_of(program, 2), 5 * kPi, 1e-9);
}

TEST(HeidenhainContour, MirrorsWhatIsTurned) {
    const motion::Program program = conversational(after_start(R"(4 CYCL DEF 8.0 MIRROR IMAGE
5 CYCL DEF 8.1 X
6 CYCL DEF 10.0 ROTATION
7 CYCL DEF 10.1 ROT+30
8 L X+20 Y+0 F100
9 L X+20 Y+10
)"));
    ASSERT_EQ(program.moves.size(), 2U);
    const double half = 0.5, high = std::sqrt(0.75);
    expect_near(program.moves[0].end.tip_mm, {-20 * high, 20 * half, 10}, 1e-12);
    expect_near(program.moves[1].end.tip_mm, {-20 * high + 10 * half, 20 * half + 10 * high, 10}, 1e-12);
}

TEST(HeidenhainContour, RefusesWhatDoesNotFit) {
    const Refusal refusals[] = {
        {with_cutter("L X+0 Y+0 RR F200\nL Y+4\nL X+4\nL Y+0\n"), 7, 1,
         "does not fit into the inside corner"},
        {with_cutter("L X+0 Y+0 RL F200\nCC X-2 Y+0\nC X-2 Y+2 DR+\nL X-9\n"), 7, 1,
         "the arc's radius 2 mm is not larger than the cutter's, 5 mm"},
        {with_cutter("CC X+0 Y+0\nC X+20 Y+20 RL DR+ F200\n"), 6, 3, "begins with a circle"},
        {after_start("L X+3 F100\nRND R9\nL Y+3\n"), 5, 1, "RND of 9 mm does not fit"},
        {after_start("L X+3 F100\nCHF 4\nL Y+3\n"), 5, 1, "CHF of 4 mm does not fit"},
        {after_start("L X+3 F100\nRND R1\nL Z+3\n"), 5, 1, "RND does not stand between two elements"},
        {after_start("L X+3 F100\nRND\nL Z+3\n"), 5, 4, "RND without a radius R"},
        {after_start("APPR LT X+5 Y+5 LEN5 RL F100\nL Z+3 R0\n"), 4, 1, "APPR without a contour element"},
        {after_start("APPR LT X+5 Y+5 RL F100\n"), 4, 6, "APPR or DEP without LEN"},
        {after_start("APPR CT X+5 Y+5 R5 RL F100\n"), 4, 6, "without an angle CCA"},
        {after_start("APPR LX X+5 Y+5 R5 RL F100\n"), 4, 6, "without a known shape"},
        {after_start("APPR LCT X+5 Y+0 R9 RL F100\nL Y+9\n"), 4, 1, "starts inside of its circle"},
        {after_start("DEP LT LEN5 F100\n"), 4, 5, "DEP without a contour before it"},
        {after_start("CC X+5 Y+5 Z+5\nC X+1 Y+1 Z+1 DR+ F9\n"), 5, 3, "lie in no plane of the axes"},
        {after_start("CYCL DEF 8.1 Z\n"), 4, 14, "a mirror of Z is not read"},
        {after_start("CYCL DEF 11.1 SCL 0\n"), 4, 15, "the scale is out of range"},
        {after_start("CYCL DEF 26.1 X 2 Y 1\nCC X+5 Y+0\nC X+1 Y+1 DR+ F9\n"), 6, 3, "different scales"},
        {after_start("CYCL DEF 7.1 #1\nCYCL DEF 7.1 #2\n"), 5, 15, "a second row of the datum table"},
    };
    expect_refused_conversational(refusals);
}

}  // namespace
}  // namespace tribo::readers
