// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "motion/algebra/direction.hpp"
#include "readers/refusals.hpp"
#include "readers/siemens/siemens_text.hpp"

namespace tribo::readers {
namespace {

TEST(Siemens, ReadsWordsWithEqualSigns) {
    const auto read = read_siemens(
        std::string("%_N_PART_MPF\n;$PATH=/_N_WKS_DIR\n") + std::string(kSiemensStart) +
        "N40 MSG(\"roughing (1)\")\nN50 R1=5\nN55 R2=R1*2\nN60 G1 X=R2 Y=(R1+1)*2 F=500 ; comment\nN70 "
        "STOPRE\n"
        "N80 G2 X20 Y22 CR=10\nN90 G3 X=30 Y=12 I=10 J=0\nN100 G4 F2\nN110 G0 SUPA Z300 D0\nN120 M30\n");
    ASSERT_TRUE(read.has_value()) << read.error().text();
    const motion::Program& program = *read;
    EXPECT_EQ(program.dialect, "Siemens");
    ASSERT_EQ(program.moves.size(), 4u);
    expect_near(program.moves[0].end.tip_mm, {10, 12, 10});
    EXPECT_EQ(program.moves[0].feed_mm_per_min, 500);
    EXPECT_EQ(program.moves[0].line, 9);
    EXPECT_NEAR(path_length_mm(program.moves[1]), 10 * std::numbers::pi / 2, 1e-9);
    EXPECT_NEAR(path_length_mm(program.moves[2]), 10 * std::numbers::pi / 2, 1e-9);
    EXPECT_EQ(program.moves[3].duration_s, 2);
}

TEST(Siemens, LeadsTheToolAlongVectorsWithAndWithoutAMachine) {
    const std::string text =
        "N40 TRAORI(1)\nN50 G1 X5 A3=0 B3=0.6 C3=0.8 F500\nN60 X10\nN70 X15 A3=0 B3=0 C3=1\n"
        "N80 TRAFOOF\nN90 X20\n";
    const motion::Program plain = siemens(text);
    EXPECT_FALSE(plain.has_rotary_words);
    ASSERT_EQ(plain.moves.size(), 4u);
    expect_near(plain.moves[0].start.axis, {0, 0, 1});
    expect_near(plain.moves[0].end.axis, {0, 0.6, 0.8}, 1e-15);
    expect_near(plain.moves[1].end.axis, {0, 0.6, 0.8}, 1e-15);
    expect_near(plain.moves[3].end.axis, {0, 0, 1});
    const motion::Machine machine = *motion::named_machine("head-table");
    GcodeOptions options;
    options.machine = &machine;
    const motion::Program on_machine = siemens(text, options);
    double length = 0;
    for (const motion::Move& m : on_machine.moves) {
        if (m.line < 9) length += path_length_mm(m);
        if (std::abs(m.end.tip_mm.x - 10) < 1e-9) expect_near(m.end.axis, {0, 0.6, 0.8}, 1e-6);
    }
    EXPECT_NEAR(length, 15, 1e-9);
}

TEST(Siemens, ShiftsTheZeroWithTransAndCountsTurns) {
    const motion::Program program =
        siemens("TRANS X10 Y=20\nG1 X0 Y0 F100\nG2 X0 Y0 I5 J0 TURN=2\nTRANS\nG1 X0 Y0\n");
    expect_near(program.moves[0].end.tip_mm, {10, 20, 10});
    EXPECT_NEAR(path_length_mm(program.moves[1]), 3 * 10 * std::numbers::pi, 1e-9);
    expect_near(program.moves[2].end.tip_mm, {0, 0, 10});
}

TEST(Siemens, FramesShiftTurnScaleAndMirror) {
    const struct {
        const char* text;
        Vec3 end;
    } cases[] = {
        {"TRANS X10 Y20\nATRANS X1 Z5\nX1 Y1 Z1", {12, 21, 6}},
        {"TRANS X10\nTRANS Y5\nX1 Y1 Z1", {1, 6, 1}},
        {"ROT Z90\nX1 Y2 Z3", {-2, 1, 3}},
        {"ROT RPL=90\nX1 Y2 Z3", {-2, 1, 3}},
        {"TRANS X10\nAROT Z90\nX1 Y2 Z3", {8, 1, 3}},
        {"AROT Z90\nATRANS X10\nX1 Y2 Z3", {-2, 11, 3}},
        {"ROT X90\nX1 Y2 Z3", {1, -3, 2}},
        {"ROT X90 Z90\nX1 Y2 Z3", {3, 1, 2}},  // z first, then the new x
        {"SCALE X2 Y2\nX1 Y2 Z3", {2, 4, 3}},
        {"TRANS X10\nASCALE X2\nATRANS X1\nX1 Y2 Z3", {14, 2, 3}},
        {"MIRROR X0\nX1 Y2 Z3", {-1, 2, 3}},
        {"AROT Z90\nAMIRROR X0\nX1 Y2 Z3", {-2, -1, 3}},
        {"MIRROR X0\nAROT Z90\nX1 Y2 Z3", {2, 1, 3}},
        {"ROT Z90\nROT\nX1 Y2 Z3", {1, 2, 3}},
        {"TRANS X10 Y20\nATRANS X1\nG58 X5\nX1 Y1 Z1", {7, 21, 1}},
        {"TRANS X10 Y20\nATRANS X1\nG59 X5 Z3\nX1 Y1 Z1", {16, 21, 4}},
        {"TRANS X10\nAROT Z90\nG58 X20\nG59 X1\nX1 Y2 Z3", {19, 1, 3}},
        {"$P_PFRAME=CTRANS(X,10):CROT(Z,90)\nG58 X20\nX1 Y2 Z3", {18, 1, 3}},
        {"G58\nX1 Y2 Z3", {1, 2, 3}},  // of the 802D: a work offset
        {"$P_UIFR[1]=CTRANS(X,5,Y,6):CROT(Z,90)\nG54 X1 Y0 Z0", {5, 7, 0}},
        {"$P_UIFR[2,X,TR]=5\nG55 X1 Y0 Z0", {6, 0, 0}},
        {"$P_UIFR[2,X,TR]=5\nG55\nTRANS X1\nG500 X1 Y0 Z0", {2, 0, 0}},
        {"G91 X1\nX1\nG90 Y=IC(2) Z=AC(3)", {2, 2, 3}},
        {"G91 X=AC(7) Y1 Z0", {7, 1, 10}},
        {"G70 X1 Y0 Z0", {25.4, 0, 0}},
        {"G111 X10 Y10\nG0 RP=5 AP=90 Z1", {10, 15, 1}},
        {"X3 Y4\nG110 X1 Y1\nAP=0 RP=2", {6, 5, 10}},
        {"G111 X0 Y0\nRP=5 AP=0\nAP=IC(90)", {0, 5, 10}},
        {"X1 Y1\nX5 ANG=45", {5, 5, 10}},
        {"POS[X]=4 POS[Y]=5", {4, 5, 10}},
    };
    for (const auto& c : cases) {
        const motion::Program program = siemens(std::string(c.text) + "\n");
        ASSERT_FALSE(program.moves.empty()) << c.text;
        SCOPED_TRACE(c.text);
        expect_near(program.moves.back().end.tip_mm, c.end, 1e-12);
    }
}

TEST(Siemens, CirclesOfAllKindsHaveTheirLengths) {
    // From X0 Y0 Z10.
    const struct {
        const char* text;
        double length;
        Vec3 end;
    } cases[] = {
        {"G2 X10 Y0 I5 J0", 5 * kPi, {10, 0, 10}},
        {"G3 X10 Y0 I=AC(5) J=AC(0)", 5 * kPi, {10, 0, 10}},
        {"G2 X10 Y10 CR=10", 5 * kPi, {10, 10, 10}},
        {"G2 X10 Y10 CR=-10", 15 * kPi, {10, 10, 10}},
        {"G3 X0 Y0 I5 J0", 10 * kPi, {0, 0, 10}},
        {"G3 X0 Y0 Z4 I5 J0 TURN=2", std::hypot(30 * kPi, 6), {0, 0, 4}},
        {"G2 X10 Y0 AR=180", 5 * kPi, {10, 0, 10}},
        {"G3 I5 J0 AR=90", 2.5 * kPi, {5, -5, 10}},
        {"G3 X10 Y0 AR=270", 1.5 * kPi * std::sqrt(50.0), {10, 0, 10}},
        {"G111 X5 Y0\nG2 RP=5 AP=90", 2.5 * kPi, {5, 5, 10}},
        {"CIP X10 Y0 I1=5 J1=5", 5 * kPi, {10, 0, 10}},
        {"CIP X10 Y0 I1=5 J1=0 K1=15 Z10", 5 * kPi, {10, 0, 10}},
        {"G18 G2 X10 Z10 I5 K0", 5 * kPi, {10, 0, 10}},
        {"G19 G3 Y10 Z10 J5 K0", 5 * kPi, {0, 10, 10}},
        {"MIRROR Y0\nG2 X10 Y0 I5 J0", 5 * kPi, {10, 0, 10}},
        {"ROT X90\nG2 X10 Y10 I5 J0", 5 * kPi, {10, 0, 10}},
    };
    for (const auto& c : cases) {
        const motion::Program program = siemens("F100\n" + std::string(c.text) + "\n");
        SCOPED_TRACE(c.text);
        EXPECT_NEAR(feed_mm(program), c.length, 1e-9);
        expect_near(end_of(program), c.end, 1e-9);
    }
    // A quarter after a line, tangent to it.
    const motion::Program tangent = siemens("F100\nG1 X10\nCT X20 Y10\n");
    EXPECT_NEAR(feed_mm(tangent), 10 + 5 * kPi, 1e-9);
    EXPECT_GT(siemens("F100\nMIRROR Y0\nG2 X10 Y0 I5 J0\n").moves[0].arc->normal.z, 0);
}

TEST(Siemens, CornersAreRoundedAndCut) {
    // From X0 over X20 to Y20.
    const double leg = 20;
    const struct {
        const char* text;
        double length;
    } cases[] = {
        {"G1 X20 RND=5\nY20", 2 * (leg - 5) + 2.5 * kPi},
        {"G1 X20 CHR=5\nY20", 2 * (leg - 5) + 5 * std::sqrt(2.0)},
        {"G1 X20 CHF=5\nY20", 2 * (leg - 5 / std::sqrt(2.0)) + 5},
        {"G1 X20\nY20 RND=5\nG0 Z20", 2 * leg},
        {"RNDM=5\nG1 X20\nY20\nRNDM=0", 2 * (leg - 5) + 2.5 * kPi},
        {"RNDM=5\nG1 X20\nY20\nX0\nRNDM=0\n", 3 * leg - 4 * 5 + 5 * kPi},
    };
    for (const auto& c : cases) {
        EXPECT_NEAR(feed_mm(siemens("F100\n" + std::string(c.text) + "\n")), c.length, 1e-9) << c.text;
    }
}

TEST(Siemens, CompensatesTheRadiusInEveryPlane) {
    GcodeOptions options;
    options.tools = {{1, 10}};
    // A square of 40 mm, left of it: four sides and three quarters of 5 mm, the way there and back.
    const motion::Program flat = siemens("F100\nG1 G41 X10 Y10\nY50\nX50\nY10\nX10\nG40 X0 Y0\n", options);
    EXPECT_NEAR(feed_mm(flat), std::hypot(5, 10) + 4 * 40 + 3 * 2.5 * kPi + std::hypot(10, 5), 1e-9);
    const motion::Program side =
        siemens("F100\nG0 Z0\nG18\nG1 G42 X10 Z10\nZ50\nX50\nZ10\nX10\nG40 X0 Z0\n", options);
    EXPECT_NEAR(feed_mm(side), feed_mm(flat), 1e-9);
    // Nobody states the radius: the programmed path.
    const motion::Program unknown = siemens("F100\nG1 G41 X10 Y10\nY50\nG40 X0\n");
    EXPECT_NEAR(feed_mm(unknown), std::hypot(10, 10) + 40 + 10, 1e-9);
    EXPECT_TRUE(warns_of(unknown, 5, "nothing states the radius of tool 1"));
    // By the tool data of the program.
    EXPECT_NEAR(feed_mm(siemens("$TC_DP6[1,1]=5\nF100\nG1 G41 X10 Y10\nY50\nX50\nY10\nX10\nG40 X0 Y0\n")),
                feed_mm(flat), 1e-9);
}

TEST(Siemens, CountsFeedsPerToothByTheToolsOfTheJob) {
    GcodeOptions options;
    options.tools = {{1, 10, {}, 4}};
    const motion::Program program = siemens("S900 M3\nG95 G1 X10 FZ=0.05\n", options);
    EXPECT_NEAR(program.moves.back().feed_mm_per_min, 4 * 0.05 * 900, 1e-9);
}

TEST(Siemens, SplinesAndPolynomials) {
    // A cubic B-spline of four points is a Bezier curve.
    const motion::Program spline = siemens("F100\nBSPLINE X0 Y10\nX10 Y10\nX10 Y0\nG1 X20\n");
    const auto at = [](double t) {
        const double s = 1 - t;
        return Vec3{30 * s * t * t + 10 * t * t * t, 30 * s * s * t + 30 * s * t * t, 10};
    };
    double length = 0;
    for (int i = 0; i < 20'000; ++i) length += distance(at(i / 20'000.0), at((i + 1) / 20'000.0));
    EXPECT_NEAR(feed_mm(spline), length + 10, 1e-4);
    for (const motion::Move& move : spline.moves) {
        if (move.line != 5) continue;
        double nearest = 1;
        for (int i = 0; i <= 2000; ++i)
            nearest = std::min(nearest, distance(move.end.tip_mm, at(i / 2000.0)));
        EXPECT_LT(nearest, 1e-2);
    }
    // A parabola over 0 to 2: x = 5 p, y = 2 p^2.
    const motion::Program poly = siemens("F100\nPOLY PO[X]=(10) PO[Y]=(8,2) PL=2\nG1 X20 Y8\n");
    double arc = 0;
    const auto on = [](double p) { return Vec3{5 * p, 2 * p * p, 10}; };
    for (int i = 0; i < 20'000; ++i) arc += distance(on(i / 1e4), on((i + 1) / 1e4));
    EXPECT_NEAR(feed_mm(poly), arc + 10, 1e-4);
}

TEST(Siemens, LeadsSplinesThroughTheirPoints) {
    const auto nearest = [](const motion::Program& program, Vec3 p) {
        double least = 1e9;
        for (const motion::Move& move : program.moves)
            for (int i = 0; i <= 100; ++i)
                least = std::min(least, distance(motion::pose_at(move, 0.01 * i).tip_mm, p));
        return least;
    };
    // The natural spline through three points of even chords: 1.5 u - 0.5 u^3 of the rise after a share u.
    const motion::Program cubic = siemens("F100\nCSPLINE X10 Y10\nX20 Y0\nG1 X30\n");
    EXPECT_TRUE(warns_of(cubic, 5, "natural cubic spline"));
    for (const Vec3 p : {Vec3{10, 10, 10}, Vec3{20, 0, 10}, Vec3{2, 2.96, 10}, Vec3{18, 2.96, 10}})
        EXPECT_LT(nearest(cubic, p), 0.02);
    expect_near(end_of(cubic), {30, 0, 10});
    // Akima's curve follows points on a line until the last of them, a natural spline swings before.
    const std::string bend = " X10 Y0\nX20\nX30 Y10\nX40 Y15\nG0 Z50\n";
    const auto lowest = [&](const std::string& word) {
        double y = 0;
        for (const motion::Move& move : siemens("F100\n" + word + bend).moves)
            y = std::min(y, move.end.tip_mm.y);
        return y;
    };
    EXPECT_NEAR(lowest("ASPLINE"), 0, 1e-9);
    EXPECT_LT(lowest("CSPLINE"), -0.2);
    // Two points, and one of them twice: a line.
    EXPECT_NEAR(feed_mm(siemens("F100\nCSPLINE X30 Y40\nX30 Y40\nG0 Z50\n")), 50, 1e-9);
    EXPECT_NEAR(feed_mm(siemens("F100\nASPLINE X0 Y0\nG0 Z50\n")), 0, 1e-9);
}

TEST(Siemens, TakesTextBehindAWordForAComment) {
    const motion::Program program = siemens("T2 M6 (T2 D=10.)\nF100 (SLOW) G1 (LINE) X5 (END)\n");
    EXPECT_NEAR(feed_mm(program), 5, 1e-9);
    ASSERT_EQ(program.tools.size(), 1u);
    EXPECT_EQ(program.tools[0].diameter_mm, 10);
}

TEST(Siemens, ReadsAllSettingsOfABlock) {
    const motion::Program program = siemens(
        "$TC_DP1[1,1]=120 $TC_DP3[1,1]=100 $TC_DP6[1,1]=3*2 $TC_DP7[1,1]=1\n$MC_A=$MN_B+1 G70\nT1 M6\nF10 G1 "
        "X1\n");
    ASSERT_EQ(program.tools.size(), 1u);
    EXPECT_EQ(program.tools[0].diameter_mm, 12);
    EXPECT_EQ(program.tools[0].corner_mm, 1);
    EXPECT_TRUE(warns_of(siemens("G70\nF10 G1 X1\n"), 4, "F is taken in inches per minute"));
}

TEST(Siemens, TakesVariablesOfTheControlThatItSets) {
    const motion::Program program = siemens("_CAMTOLERANCE=0.01\nF100 G1 X=_CAMTOLERANCE*500\n_NAME=\"A\"\n");
    EXPECT_NEAR(feed_mm(program), 5, 1e-9);
    EXPECT_TRUE(warns_of(program, 4, "_CAMTOLERANCE is not defined in the program"));
}

TEST(Siemens, TurnsFramesAlongTheTool) {
    const std::string leans = "TRAORI\nG0 X10 Y0 Z0 A3=3 B3=0 C3=4\n";  // x of the frame: 0.8, 0, -0.6
    const struct {
        std::string text;
        Vec3 end;
    } cases[] = {
        {leans + "TOROT\nG91 Z10", {16, 0, 8}},
        {leans + "TOROT\nX0 Y0 Z10", {6, 0, 8}},
        {leans + "TOFRAME\nX5 Y1 Z10", {20, 1, 5}},
        {leans + "TOFRAME\nG91 X5 Z10\nTOFRAMEOF\nG90 X1 Y2 Z3", {1, 2, 3}},
        {"TRANS X100\n" + leans + "TOROT\nTOROT\nG91 Z10", {116, 0, 8}},
        {"TRANS X100\n" + leans + "TOFRAME\nTRANS\nX0 Y0 Z0", {30, 0, 60}},
        {"ROT Z90\n" + leans + "TOROT\nG91 Z10", {0, 16, 8}},
        {"TRAORI\nG0 X10 Y0 Z0 A3=0 B3=1 C3=0\nTOROT\nG91 Z10 X1", {11, 10, 0}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.text);
        expect_near(end_of(siemens(c.text + "\n")), c.end, 1e-9);
    }
}

TEST(Siemens, SwivelsPlanes) {
    // About Y by 90 degrees: the plane's z is the stock's x.
    const struct {
        const char* swivel;
        Vec3 axis, end;  // of X1 Y2 Z3
    } cases[] = {
        {"CYCLE800(0,\"TC\",0,57,0,0,0,0,90,0,0,0,0,-1)", {1, 0, 0}, {3, 2, -1}},
        {"CYCLE800(0,\"TC\",0,57,10,20,30,0,90,0,0,0,0,-1)", {1, 0, 0}, {13, 22, 29}},
        {"CYCLE800(0,\"TC\",0,57,0,0,0,0,90,0,0,0,5,-1)", {1, 0, 0}, {8, 2, -1}},
        {"CYCLE800(0,\"TC\",0,27,0,0,0,90,90,0,0,0,0,-1)", {0, 1, 0}, {-2, 3, -1}},  // z, then y
        {"CYCLE800(0,\"TC\",0,64,0,0,0,90,90,0,0,0,0,-1)", {0, 1, 0}, {-2, 3, -1}},  // solid angles
        {"CYCLE800(0,\"TC\",0,57,0,0,0,0,0,90)\nCYCLE800(0,\"TC\",1,57,0,0,0,0,90,0)",
         {0, 1, 0},
         {-2, 3, -1}},
        {"CYCLE800(0,\"TC\",0,57,0,0,0,0,90,0,0,0,0,-1)\nCYCLE800()", {0, 0, 1}, {1, 2, 3}},
    };
    for (const auto& c : cases) {
        const motion::Program program = siemens(std::string(c.swivel) + "\nG0 X0 Y0 Z50\nG1 X1 Y2 Z3 F100\n");
        SCOPED_TRACE(c.swivel);
        ASSERT_FALSE(program.moves.empty());
        expect_near(end_of(program), c.end, 1e-12);
        expect_near(program.moves.back().end.axis, c.axis, 1e-12);
    }
}

TEST(Siemens, TurnsTheToolAlongACircleOnAMachine) {
    const motion::Machine machine = *motion::named_machine("head-table");
    GcodeOptions options;
    options.machine = &machine;
    const std::string text =
        "TRAORI\nG0 X10 Y0 Z0 A3=0 B3=0 C3=1\nG3 X-10 Y0 CR=10 A3=0 B3=0.6 C3=0.8 F500\n";
    const motion::Program program = siemens(text, options);
    for (const motion::Move& m : program.moves) {
        if (m.kind != motion::MoveKind::feed) continue;
        for (const Vec3 tip : {m.start.tip_mm, pose_at(m, 0.5).tip_mm, m.end.tip_mm})
            EXPECT_NEAR(std::hypot(tip.x, tip.y), 10, 1e-3);
        EXPECT_NEAR(m.end.tip_mm.z, 0, 1e-9);
    }
    EXPECT_NEAR(feed_mm(program), 10 * std::numbers::pi, 1e-3);
    expect_near(end_of(program), {-10, 0, 0}, 1e-9);
    expect_near(program.moves.back().end.axis, {0, 0.6, 0.8}, 1e-9);
    // Half of the turn at half of the way.
    const auto& middle = *std::ranges::min_element(program.moves, {}, [](const motion::Move& m) {
        return m.kind == motion::MoveKind::feed ? distance(m.end.tip_mm, {0, 10, 0}) : 1e9;
    });
    EXPECT_NEAR(motion::angle_rad(middle.end.axis, {0, 0, 1}), 0.5 * std::acos(0.8), 0.02);
    const auto refused = read_siemens(std::string(kSiemensStart) + text, {});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().text().find("the tool turns along a circle"), std::string::npos);
}

TEST(Siemens, SaysThatUnitsAreThoseOfAnotherMode) {
    const motion::Program program = siemens("G20 G1 X1 F10\nG21 X26\n");
    expect_near(end_of(program), {26, 0, 10});
    EXPECT_NEAR(program.moves[0].end.tip_mm.x, 25.4, 1e-12);
    EXPECT_TRUE(warns_of(program, 4, "words of the ISO mode"));
}

TEST(Siemens, TurnsTheToolByAngles) {
    const double r = std::sqrt(0.5);
    const motion::Program rpy = siemens("ORIRPY\nTRAORI\nG1 X1 F100 A2=0 B2=45 C2=90\n");
    expect_near(rpy.moves.back().end.axis, {0, r, r}, 1e-12);
    const motion::Program euler = siemens("ORIEULER\nTRAORI\nG1 X1 F100 A2=90 B2=45\n");
    expect_near(euler.moves.back().end.axis, {r, 0, r}, 1e-12);
}

TEST(Siemens, FeedsCountPerTurnPerToothAndInverse) {
    EXPECT_EQ(siemens("G95 G1 X10 F0.1\n").moves[0].feed_mm_per_min, 300);
    EXPECT_EQ(siemens("G93 G1 X10 F2\n").moves[0].feed_mm_per_min, 20);
    const motion::Program block = siemens("G1 X10 F100 FB=50\nX20\n");
    EXPECT_EQ(block.moves[0].feed_mm_per_min, 50);
    EXPECT_EQ(block.moves[1].feed_mm_per_min, 100);
    EXPECT_EQ(siemens("G4 S50\n").moves[0].duration_s, 1);
}

TEST(Siemens, NamesToolsAndReadsTheirData) {
    const motion::Program program = siemens("$TC_DP6[7,1]=4\nT=\"MILL\" M6\nG1 X1 F100\nT=\"7\" M6\nG1 X2\n");
    EXPECT_TRUE(warns_of(program, 5, "the tool \"MILL\" counts as tool 2"));
    EXPECT_EQ(program.moves[0].tool, 2);
    EXPECT_EQ(program.moves[1].tool, 7);
    ASSERT_EQ(program.tools.size(), 1u);
    EXPECT_EQ(program.tools[0].diameter_mm, 8);
}

// Words that do not change the path, with a warning or without.
TEST(Siemens, TakesTheStockAndTheTextsOfToolsFromTheProgram) {
    const std::string head = "; T3 D=6 CR=0 - flat end mill\nT3 M6\n";
    const motion::Program program =
        siemens("WORKPIECE(,\"\",,\"BOX\",112,2,-20,-80,40,0,-10,30)\nG1 X5 F9\n");
    ASSERT_TRUE(program.stock);
    EXPECT_EQ(program.stock->box_mm.min, (Vec3{-10, 0, -20}));
    EXPECT_EQ(program.stock->box_mm.max, (Vec3{40, 30, 2}));
    // The far corner counted from the near one.
    const motion::Program counted =
        siemens("WORKPIECE(,\"\",,\"BOX\",0,2,-30,-80,-2,-3,184,170)\nG1 X5 F9\n");
    ASSERT_TRUE(counted.stock.has_value());
    expect_near(counted.stock->box_mm.min, {-2, -3, -28});
    expect_near(counted.stock->box_mm.max, {182, 167, 2});
    EXPECT_FALSE(siemens("WORKPIECE(,\"\",,\"BOX\",16,2,-30,-80,-2,-2,184,170)\nG1 X5 F9\n").stock);
    const motion::Program compensated = siemens(head + "F100\nG1 G41 X10 Y10\nY50\nG40 X0\n");
    EXPECT_NEAR(feed_mm(compensated), std::hypot(7, 10) + 40 + 7, 1e-9);
}

TEST(Siemens, PassesOverWhatMovesNothing) {
    const std::string with = "G1 X10 F100\nX20\n";
    const double length = feed_mm(siemens(with));
    for (const char* text : {"MSG(\"text; (1)\")",
                             "STOPRE",
                             "SOFT",
                             "FFWON",
                             "COMPCAD",
                             "FIFOCTRL",
                             "G642 ADIS=0.05",
                             "G500",
                             "WORKPIECE(,\"\",,\"BOX\",112,0,-20,-80,-20,-20,20,20)",
                             "GROUP_BEGIN(0,\"a\",0,0)",
                             "DIAMOF",
                             "CUT2DF",
                             "CYCLE832(0.01,_ORI_FINISH,1)",
                             "M117",
                             "M1=8",
                             "H5",
                             "H1=5",
                             "D1",
                             "D0",
                             "SETMS(1)",
                             "/8 G1 X99",
                             "N5",
                             "LABEL:",
                             "SPOS=0",
                             "WHEN $AC_TIME>1 DO $A_OUT[1]=1",
                             "$SC_X=5",
                             "EXTERN A(REAL)",
                             "TRAFOOF",
                             "ORIWKS ORIAXES",
                             "G601 G9 G60",
                             "G25 X-10",
                             "M8 M9",
                             "LIMS=2000",
                             "R5=5 R6=R5*2",
                             "(a comment)",
                             "G43 H1",
                             "RTLION",
                             "A0",
                             "; only text"}) {
        const motion::Program program = siemens(std::string(text) + "\n" + with);
        EXPECT_NEAR(feed_mm(program), length, 1e-12) << text;
        EXPECT_FALSE(program.has_rotary_words) << text;
    }
}

TEST(Siemens, RefusesWithPlaceCauseAndRemedy) {
    const std::string start(kSiemensStart);
    const std::vector<Refusal> refusals = {
        {start + "G33 Z-5 K1\n", 4, 1, "G33 (threads of a lathe)"},
        {start + "G77\n", 4, 1, "G77 is not known"},
        {start + "N40 FOO X5\n", 4, 5, "the word FOO is not known"},
        {start + "N40 G1 Q9=5\n", 4, 8, "Q9= is not known"},
        {start + "N40 MSG(\"open\n", 4, 8, "the parenthesis does not close"},
        {start + "N40 G1 X=\n", 4, 10, "a value is missing"},
        {start + "N40 G1 X=NOWHERE\n", 4, 10, "'NOWHERE' is not known"},
        {start + "N40 G1 X=$AA_IM[X]\n", 4, 10, "only the machine knows $AA_IM"},
        {start + "N40 R1=1/0\n", 4, 9, "a division by zero"},
        {start + "IF R1==0\nG1 X5\n", 4, 3, "IF without ENDIF"},
        {start + "WHILE 1\nG1 X5\n", 4, 6, "WHILE without its end"},
        {start + "ENDFOR\n", 4, 7, "ENDFOR without its beginning"},
        {start + "GOTOF NOWHERE\n", 4, 6, "there is no label NOWHERE"},
        {start + "REPEAT NOWHERE\n", 4, 8, "the lines to repeat are not in this program"},
        {start + "DEF WORD A\n", 4, 11, "DEF without a type"},
        {start + "DEF REAL A[3]\nA[3]=1\n", 5, 1, "the index lies outside"},
        {start + "TRAANG(40)\n", 4, 1, "TRAANG (an inclined axis)"},
        {start + "CYCLE64(\"A\",1)\n", 4, 1, "CYCLE64 (holes that"},
        {start + "CYCLE99(1)\n", 4, 1, "CYCLE99 is not read"},
        {start + "HOLES1(0,0,0,0,5,3)\n", 4, 1, "HOLES1 without MCALL"},
        {start + "F100\nCYCLE81(5,0,1)\n", 5, 1, "CYCLE81 has no depth"},
        {start + "F100\nCYCLE81(5,0,1,10)\n", 5, 1, "the depth is not below RFP"},
        {start + "CYCLE800(0,\"\",0,192,0,0,0,10,20,0,0,0,0,1)\n", 4, 1, "the machine's own axes"},
        {start + "SCALE X2\nF100 G2 X10 Y0 I5 J0\n", 5, 1, "a circle in a frame with different scales"},
        {start + "SCALE X0\n", 4, 7, "the scale is out of range"},
        {start + "TOROTX\n", 4, 1, "TOROTX (frames whose X"},
        {start + "AROTS X5 Y5\n", 4, 1, "AROTS (frames by solid angles)"},
        {start + "F100 G1 X10 RND=50\nY10\n", 4, 1, "RND of 50 mm does not fit"},
        {start + "@100 K5\n", 4, 1, "@ codes"},
        {start + "G1 X5\n", 4, 1, "a feed move before any F"},
        {start + "F100 G2 X10 Y0\n", 4, 1, "a circle without centre, radius or opening angle"},
        {start + "F100 CIP X10 Y0 I1=5 J1=0\n", 4, 1, "lie on a line"},
        {start + "N40 R1=" + std::string(5000, '1') + "\n", 4, 4097, "the block has 5007 characters"},
        {"", 0, 0, "no Siemens program in this file"},
    };
    expect_refused(refusals, [](const std::string& text, const std::string& name) {
        GcodeOptions options;
        options.source_name = name;
        return read_siemens(text, options);
    });
}

}  // namespace
}  // namespace tribo::readers
