// SPDX-License-Identifier: MIT
// Free contours (FK) against closed forms, and against the same contour in L and C blocks.
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <sstream>

#include "readers/heidenhain/heidenhain_text.hpp"

namespace tribo::readers {
namespace {

// Text of a number, to all its digits.
std::string number(double value) {
    std::ostringstream out;
    out.precision(15);
    out << std::showpos << std::fixed << value;
    return out.str();
}

std::string at(double x, double y) {
    return " X" + number(x) + " Y" + number(y);
}

TEST(HeidenhainFree, RunsABeltAroundThreeCircles) {
    const motion::Program program = conversational(after_start(R"(3 L X-20 Y+30 F100
4 L X+2
5 FC DR- R18 CLSD+ CCX+20 CCY+30
6 FLT
7 FCT DR- R15 CCX+50 CCY+75
8 FLT
9 FCT DR- R15 CCX+75 CCY+20
10 FLT
11 FCT DR- R18 CLSD- CCX+20 CCY+30
12 L X-20
)"));
    const struct {
        double x, y, r;
    } circles[] = {{20, 30, 18}, {50, 75, 15}, {75, 20, 15}};
    // A belt: outer tangents, and arcs that turn by the angles between them, once around in all.
    double belt = 0, before = 0;
    double tangent_deg[3];
    for (int k = 0; k < 3; ++k) {
        const auto &a = circles[k], &b = circles[(k + 1) % 3];
        const double d = std::hypot(b.x - a.x, b.y - a.y);
        belt += std::sqrt(d * d - (a.r - b.r) * (a.r - b.r));
        tangent_deg[k] = std::atan2(b.y - a.y, b.x - a.x) + std::asin((b.r - a.r) / d);
    }
    for (int k = 0; k < 3; ++k) {
        before = tangent_deg[(k + 2) % 3];
        belt += circles[k].r * std::remainder(before - tangent_deg[k] - kPi, 2 * kPi) + circles[k].r * kPi;
    }
    ASSERT_EQ(program.moves.size(), 10U);
    double length = 0;
    for (std::size_t k = 2; k < 9; ++k) length += length_of(program, k);
    EXPECT_NEAR(length, belt, 1e-8);
    expect_near(program.moves[8].end.tip_mm, {2, 30, 10}, 1e-8);
    expect_near(program.moves[4].arc->centre_mm, {50, 75, 10}, 1e-8);
    EXPECT_EQ(program.moves[4].line, 8);
}

// A polyline with rounded corners, as L with RND, and as free blocks that state directions, radii, some
// lengths and the last end.
TEST(HeidenhainFree, FindsRoundedPolylines) {
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / static_cast<double>(UINT32_MAX);
    };
    for (int run = 0; run < 60; ++run) {
        const int corners = 1 + run % 3;
        double x = between(-50, 50), y = between(-50, 50), angle = between(-180, 180);
        const std::string start = "3 L" + at(x, y) + " F100\n";
        std::string plain = start, free = start;
        double cut = 0;  // what the corner before takes from the side
        for (int k = 0; k <= corners; ++k) {
            const double side = between(20, 60), turn = (run % 2 != 0 ? 1 : -1) * between(20, 130);
            const double radius = between(1, 4);
            const double next_cut = radius * std::tan(std::abs(turn) * kPi / 360);
            x += side * std::cos(angle * kPi / 180);
            y += side * std::sin(angle * kPi / 180);
            plain += "L" + at(x, y) + "\n";
            // The lengths of the first and the last side are left open.
            free += std::string(k == 0 ? "FL" : "FLT") + " AN" + number(angle);
            if (k == corners) free += at(x, y);
            if (k > 0 && k < corners) free += " LEN" + number(side - cut - next_cut);
            free += "\n";
            if (k == corners) break;
            plain += "RND R" + number(radius).substr(1) + "\n";
            free += "FCT R" + number(radius) + (turn > 0 ? " DR+\n" : " DR-\n");
            cut = next_cut;
            angle += turn;
        }
        const motion::Program expected = conversational(after_start(plain + "L X+0\n"));
        const motion::Program program = conversational(after_start(free + "L X+0\n"));
        ASSERT_EQ(program.moves.size(), expected.moves.size()) << free;
        for (std::size_t k = 0; k < program.moves.size(); ++k) {
            expect_near(program.moves[k].end.tip_mm, expected.moves[k].end.tip_mm, 1e-6);
            expect_near(pose_at(program.moves[k], 0.5).tip_mm, pose_at(expected.moves[k], 0.5).tip_mm, 1e-6);
        }
    }
}

// Each way to state an element, and where its end lies.
TEST(HeidenhainFree, ReadsEveryStatement) {
    const double root3 = std::sqrt(3.0);
    const struct {
        const char* blocks;
        Vec3 end;  // of the last element
    } cases[] = {
        {"FL X+10 Y+20\n", {10, 20, 10}},
        {"FL IX+10 IY+20\nFL IX+5 IY-1\n", {15, 19, 10}},
        {"FPOL X+10 Y+0\nFL PR+10 PA+90\n", {10, 10, 10}},
        {"FPOL X-10 Y+0\nFL IPR+10 IPA+90\n", {-10, 20, 10}},
        {"FL AN+30 LEN20\n", {10 * root3, 10, 10}},
        {"FL AN+30 X+17.3205080756888\n", {10 * root3, 10, 10}},
        {"FL X+10 Y+0\nFL IAN+90 LEN5\n", {10, 5, 10}},
        {"5 FL X+10 Y+0\n6 FL X+20 Y+20\n7 FL IAN+90 RAN 5 LEN5\n", {20, 25, 10}},
        {"5 FL X+10 Y+0\n6 FL X+20 Y+20\n7 FL IX+1 RX 5 IY+2 RY 6\n", {11, 22, 10}},
        {"FPOL X+0 Y+0\n5 FL X+10 Y+0\n6 FL X+20 Y+20\n7 FL IPR+5 RPR 5 PA+90\n", {0, 15, 10}},
        // Back beside the first line, 5 above it.
        {"5 FL X+10 Y+0\n6 FL X+10 Y+5\n7 FL PAR 5 DP 5 X+2\n", {2, 5, 10}},
        // A line whose direction an auxiliary point gives, and one that passes a point at a distance.
        {"FL P1X+3 P1Y+4 X+6\n", {6, 8, 10}},
        {"FL AN+90 Y+5\nFL X+20 P2X+10 P2Y+10\n", {20, 15, 10}},
        {"FL X+10 Y+0\nFL AN+90 Y+7 PDX+15 PDY+3 D5\n", {10, 7, 10}},
        // A quarter of a circle, by centre and by angle, chord, polar centre and tangent.
        {"FC DR+ R10 CCX+0 CCY+10 X+10 Y+10\n", {10, 10, 10}},
        {"FL X+10 Y+0\nFCT DR+ R10 CCA90\n", {20, 10, 10}},
        {"FL X+10 Y+0\nFCT DR+ R10 LEN14.1421356237310 X+20\n", {20, 10, 10}},
        {"FL X+10 Y+0\nFCT DR+ X+20 Y+10\n", {20, 10, 10}},
        {"FPOL X+0 Y+0\nFL X+10 Y+0\nFC DR+ CCPR+20 CCPA+0 PR+10 PA+0 R10\n", {10, 0, 10}},
        {"FL X+10 Y+0\nFC DR- AN+90 R10 X+30\n", {30, 0, 10}},
        {"5 FL X+10 Y+0\n6 FC DR- ICCX+10 RCCX 5 ICCY+0 RCCY 5 X+30\n", {30, 0, 10}},
        {"FL X+10 Y+0\nFC CCX+10 CCY+5 DR+ R5\n", {10, 0, 10}},  // a full circle
        // A line that touches a circle: at 30 degrees from a point twice the radius away.
        {"FL\nFCT DR- R10 CCX+20 CCY+0 X+30 Y+0\n", {30, 0, 10}},
    };
    for (const auto& one : cases) {
        const motion::Program program =
            conversational(after_start("4 L X+0 F100\n" + std::string(one.blocks)));
        ASSERT_FALSE(program.moves.empty()) << one.blocks;
        // 1e-5: where X is the circle's largest, its end is a double root.
        EXPECT_NEAR(distance(program.moves.back().end.tip_mm, one.end), 0, 1e-5) << one.blocks;
    }
    // The line that touches ends where its tangent does.
    const motion::Program touching =
        conversational(after_start("FL F100\nFCT DR- R10 CCX+20 CCY+0 X+30 Y+0\n"));
    expect_near(touching.moves[0].end.tip_mm, {15, 5 * root3, 10}, 1e-6);
}

TEST(HeidenhainFree, RoundsAndOffsetsItsCorners) {
    const std::string start =
        "0 BEGIN PGM P MM\n1 TOOL DEF 1 L+0 R+5\n2 TOOL CALL 1 Z S2000 F500\n3 L X-20 Y-20 Z+0 R0 FMAX M3\n";
    const motion::Program plain = conversational(
        start + "APPR LCT X+0 Y+0 R3 RL F200\nL Y+50\nRND R6\nL X+50\nL Y+0\nDEP LCT X-20 Y-20 R3\n");
    const motion::Program free =
        conversational(start +
                       "APPR LCT X+0 Y+0 R3 RL F200\nFL AN+90 LEN50\nRND R6\nFL AN+0 X+50\nFL AN-90 Y+0\n"
                       "DEP LCT X-20 Y-20 R3\n");
    ASSERT_EQ(plain.moves.size(), free.moves.size());
    for (std::size_t k = 0; k < plain.moves.size(); ++k)
        expect_near(plain.moves[k].end.tip_mm, free.moves[k].end.tip_mm, 1e-9);
}

TEST(HeidenhainFree, ChoosesFromSeveralContours) {
    // A line at 40 degrees meets a circle of radius 15 twice: 20 and 50 from the pole.
    const std::string two = "FPOL X+0 Y+0\nFL AN+40 F100\nFC DR+ R15 CCPR+35 CCPA+40";
    const motion::Program near = conversational(after_start(two + " CCA90\nFSELECT1\n"));
    const motion::Program far = conversational(after_start(two + " CCA90\nFSELECT2\n"));
    EXPECT_NEAR(length_of(near, 0), 20, 1e-6);
    EXPECT_NEAR(length_of(far, 0), 50, 1e-6);
    EXPECT_TRUE(warns_of(near, 7, "counted from the shortest on"));
    // What follows decides too: a line at the height where only the arc of the far one ends.
    const double y = 35 * std::sin(40 * kPi / 180) + 15 * std::cos(40 * kPi / 180);
    const motion::Program decided =
        conversational(after_start(two + " CCA90\nFL AN+0 IX+10 Y" + number(y) + "\n"));
    ASSERT_EQ(decided.moves.size(), 3U);
    EXPECT_NEAR(length_of(decided, 0), 50, 1e-6);
}

TEST(HeidenhainFree, RefusesWhatDoesNotFit) {
    const Refusal refusals[] = {
        {after_start("FL AN+40 F100\nL X+5\n"), 4, 1, "does not say where this element lies"},
        {after_start("FPOL X+0 Y+0\nFL AN+40 F100\nFC DR+ R15 CCPR+35 CCPA+40 CCA90\n"), 6, 1,
         "2 contours fit"},
        {after_start("FL X+5 Y+5 LEN3 F100\n"), 4, 1, "no element fits"},
        {after_start("FL X+5 R3 F100\n"), 4, 8, "R in a line"},
        {after_start("FL PR+5 PA+3\n"), 4, 4, "PR without a pole"},
        {after_start("FPOL X+5\n"), 4, 6, "FPOL without X and Y"},
        {after_start("FL X+5 Y+5 F9\nFL IX+1 RX 99 Y+1\n"), 5, 9, "names no block of this free contour"},
        {after_start("FL IAN+5 LEN5\n"), 4, 4, "nothing to count from"},
        {after_start("FLT X+5\n"), 4, 1, "nothing before it to be tangent to"},
        {after_start("FSELECT2\n"), 4, 1, "FSELECT without a free contour"},
        {after_start("FPOL X+0 Y+0\nFL AN+40 F100\nFC DR+ R15 CCPR+35 CCPA+40 CCA90\nFSELECT7\n"), 7, 1,
         "chooses none of the 2 contours"},
        {after_start("CYCL DEF 11.1 SCL 2\nFL X+5 Y+5\n"), 5, 1, "mirrored or scaled frame"},
        {after_start("FL X+5 Y+5 NX+3\n"), 4, 12, "does not belong into a block FL"},
        {after_start("L Z+5 M91\nFL X+5 Y+5\n"), 5, 1, "begins at an unknown place"},
    };
    expect_refused_conversational(refusals);
}

}  // namespace
}  // namespace tribo::readers
