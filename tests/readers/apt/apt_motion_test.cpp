// SPDX-License-Identifier: MIT
// Circles, cycles, frames and the other statements by which APT moves a tool.
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "readers/apt/apt_text.hpp"

namespace tribo::readers {
namespace {

using motion::Move;
using motion::MoveKind;
using motion::Program;

// The only move's arc: its turn, its middle and its length are those of the closed form.
void expect_arc(const std::string& text, Vec3 middle, double length_mm) {
    SCOPED_TRACE(text);
    const Program program = apt_in_mm(text);
    ASSERT_EQ(program.moves.size(), 1U);
    const Move& move = program.moves[0];
    EXPECT_EQ(move.kind, MoveKind::feed);
    EXPECT_NEAR(path_length_mm(move), length_mm, 1e-9);
    expect_near(pose_at(move, 0.5).tip_mm, middle, 1e-9);
    EXPECT_TRUE(program.warnings.empty());
}

TEST(AptMotion, CirclesTurnAboutTheirAxisToTheNextPoint) {
    const double r = 10, q = 10 / std::sqrt(2.0);
    const std::string from = "FROM/10,0,0\n";
    expect_arc(from + "CIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\n", {q, q, 0}, 0.5 * kPi * r);
    expect_arc(from + "CIRCLE/0,0,0,0,0,1\nGOTO/0,10,0\n", {q, q, 0}, 0.5 * kPi * r);
    expect_arc(from + "CIRCLE/0,0,0,0,0,-2,10\nGOTO/0,10,0\n", {-q, -q, 0}, 1.5 * kPi * r);
    // Creo's blanks and continuation; NX's tolerances.
    expect_arc(from + "CIRCLE / 0., 0., 0., $\n0., 0., 1., 10.\nGOTO / 0., 10., 0.\n", {q, q, 0},
               0.5 * kPi * r);
    expect_arc(from + "CIRCLE/0,0,0,0,0,1,10,0.06,0.5,D,0\nGOTO/-10,0,0\n", {0, 10, 0}, kPi * r);
    // A helix: centre and end at other heights.
    // A CLSF of NX: clockwise about the axis. A corner of Q_LOGO's kind goes on along the next line.
    const std::string nx = "TLDATA/MILL,0.1,0,3,0,0\nGOTO/-10,0,0,0,0,1\n",
                      corner = "CIRCLE/0,0,0,0,0,1,10,0.06,0.5,0,0\nGOTO/0,10,0\n";
    expect_arc(nx + corner, {-q, q, 0}, 0.5 * kPi * r);
    expect_arc(nx + "CIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\n", {q, -q, 0}, 1.5 * kPi * r);
    expect_arc(from + "CIRCLE/0,0,7,0,0,1,10\nGOTO/-10,0,4\n", {0, 10, 2}, std::hypot(kPi * r, 4));
    // In a plane across x.
    expect_arc("FROM/5,0,10\nCIRCLE/0,0,0,1,0,0,10\nGOTO/5,-10,0\n", {5, -q, q}, 0.5 * kPi * r);
}

TEST(AptMotion, AStatedAngleDecidesOnTheDirectionAndTheTurns) {
    const double r = 10, q = 10 / std::sqrt(2.0);
    const std::string from = "FROM/10,0,0\n";
    expect_arc(from + "MOVARC/0,0,0,0,0,1,10,ANGLE,90\nGOTO/0,10,0\n", {q, q, 0}, 0.5 * kPi * r);
    expect_arc(from + "MOVARC/0,0,0,0,0,1,10,ANGLE,270\nGOTO/0,10,0\n", {-q, -q, 0}, 1.5 * kPi * r);
    expect_arc(from + "MOVARC/0,0,0,0,0,1,10,ANGLE,-270\nGOTO/0,10,0\n", {-q, -q, 0}, 1.5 * kPi * r);
    expect_arc(from + "MOVARC/0,0,0,0,0,-1,10,ANGLE,90\nGOTO/0,10,0\n", {q, q, 0}, 0.5 * kPi * r);
    expect_arc(from + "MOVARC/0,0,0,0,0,1,10,ANGLE,360\nGOTO/10,0,0\n", {-10, 0, 0}, 2 * kPi * r);
    expect_arc(from + "MOVARC/0,0,0,0,0,1,10,ANGLE,540\nGOTO/-10,0,3\n", {0, -10, 1.5},
               std::hypot(3 * kPi * r, 3));
    expect_arc(from + "MOVARC/0,0,0,0,0,1,10,TIMES,2\nGOTO/-10,0,0\n", {0, -10, 0}, 3 * kPi * r);
    expect_arc(from + "MOVARC/CENTER,0,0,0,AXIS,0,0,1,RADIUS,10\nGOTO/0,10,0\n", {q, q, 0}, 0.5 * kPi * r);
}

TEST(AptMotion, CirclesOfCatiaStartAlongTheirDirection) {
    const double q = 10 / std::sqrt(2.0);
    const auto arc = [](const char* direction) {
        return "FROM/10,0,5\nINDIRV/" + std::string(direction) +
               "\nTLON,GOFWD/ (CIRCLE/ 0.0, 0.0, 5.0,$\n 10.00000),ON,(LINE/ 0.0, 0.0, 5.0,$\n 0.0, 10.0, "
               "5.0)\n";
    };
    expect_arc(arc("0,1,0"), {q, q, 5}, 5 * kPi);
    expect_arc(arc("0,-1,0"), {-q, -q, 5}, 15 * kPi);
    expect_arc("FROM/10,0,5\nINDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/0,0,5,10),ON,2,INTOF,(LINE/0,0,5,10,0,5)\n",
               {-10, 0, 5}, 20 * kPi);
}

TEST(AptMotion, PointsAlongACircleBelongToIt) {
    // Two quarter turns written as points, then a straight cut to the centre.
    const Program program = apt_in_mm(
        "FROM/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/10,0,0\nGOTO/0,10,0\nGOTO/-10,0,0\nGOTO/0,0,0\nGOTO/"
        "10,0,0\n");
    ASSERT_EQ(program.moves.size(), 4U);
    EXPECT_TRUE(program.moves[0].arc && program.moves[1].arc);
    EXPECT_FALSE(program.moves[2].arc || program.moves[3].arc);
    EXPECT_NEAR(feed_mm(program), 10 * kPi + 20, 1e-9);
    EXPECT_TRUE(program.warnings.empty());
    // Another statement ends the circle.
    const Program chord =
        apt_in_mm("FROM/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\nFEDRAT/50\nGOTO/-10,0,0\n");
    EXPECT_NEAR(feed_mm(chord), 5 * kPi + 10 * std::sqrt(2.0), 1e-9);
}

TEST(AptMotion, ACircleThatEndsWhereItStartsIsAFullTurn) {
    for (const char* after : {"", "FEDRAT/50\n", "GOTO/20,0,0\n"}) {
        const Program program =
            apt_in_mm("FROM/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/10,0,0\n" + std::string(after));
        ASSERT_GE(program.moves.size(), 1U);
        EXPECT_NEAR(path_length_mm(program.moves[0]), 20 * kPi, 1e-9);
        EXPECT_EQ(program.moves[0].line, 5);
        EXPECT_TRUE(warns_of(program, 5, "full turn"));
    }
    EXPECT_TRUE(warns_of(apt_in_mm("FROM/10,0,0\nCIRCLE/0,0,0,0,0,1,10\n"), 4, "without a point"));
}

// The heights of the moves' ends over the hole, rapid ones with an r.
std::string heights(const std::string& cycle) {
    const Program program =
        apt_in_mm("SPINDL/1000\nFROM/0,0,50\n" + cycle + "\nGOTO/0,0,0\nCYCLE/OFF\nGOTO/0,0,9\n");
    std::string text;
    for (const Move& move : program.moves) {
        const long rounded = std::lround(move.end.tip_mm.z * 1000);
        text += (text.empty() ? "" : " ") +
                std::string(move.kind == MoveKind::rapid   ? "r"
                            : move.kind == MoveKind::dwell ? "d"
                                                           : "") +
                std::to_string(rounded);
    }
    return text;
}

TEST(AptMotion, CyclesDrillAtEachPointUntilTheyAreOff) {
    // Ends with the straight cut to z 9 after CYCLE/OFF.
    EXPECT_EQ(heights("CYCLE/DRILL,FEDTO,5,MMPM,80,RAPTO,3,RTRCTO,10"), "r10000 r3000 -5000 r10000 9000");
    EXPECT_EQ(heights("CYCLE/DRILL,RAPTO,3,FEDTO,-5,RTRCTO,AUTO,MMPM,80"), "r3000 -5000 r3000 9000");
    EXPECT_EQ(heights("CYCLE / DRILL, DEPTH, 5, MMPM, 80, CLEAR, 3, RETURN, 4, DWELL, 2"),
              "r4000 r3000 -5000 d-5000 r4000 9000");
    EXPECT_EQ(heights("CYCLE/DRILL,5,MMPM,80,3"), "r3000 -5000 r3000 9000");
    EXPECT_EQ(heights("CYCLE/DRILL,5,80,MMPM,3,DWELL,1"), "r3000 -5000 d-5000 r3000 9000");
    EXPECT_EQ(heights("CYCLE/BORE,FEDTO,5,MMPM,80,RAPTO,3"), "r3000 -5000 3000 9000");
    EXPECT_EQ(heights("CYCLE/TAP,FEDTO,5,MMPR,1.25,RAPTO,3,RTRCTO,10"),
              "r10000 r3000 -5000 3000 r10000 9000");
    EXPECT_EQ(heights("CYCLE/DEEP2,FEDTO,5,1STPECK,2.5,SUBPECK,2,MMPM,80,RAPTO,3"),
              "r3000 -2500 r3000 r-2246 -4500 r3000 r-4246 -5000 r3000 9000");
    EXPECT_EQ(heights("CYCLE/DRILL,BRKCHP,FEDTO,-5,STEP,3,MMPM,80,RAPTO,3"),
              "r3000 -3000 r-2746 -5000 r3000 9000");
}

TEST(AptMotion, CyclesGoOnAtOtherPointsAndTiltedAxes) {
    const Program program = apt_in_mm(
        "SPINDL/1000\nFROM/0,0,50\nCYCLE/INIT\nCYCLE/TAP,FEDTO,5,MMPR,1.25,RAPTO,2\nGOTO/0,0,0\nCYCLE/OFF\n"
        "GOTO/0,0,50\nCYCLE/ON\nRAPID\nGOTO/20,0,0,1,0,0\n");
    ASSERT_EQ(program.moves.size(), 7U);
    EXPECT_EQ(program.moves[1].feed_mm_per_min, 1250);
    expect_near(program.moves[4].end.tip_mm, {22, 0, 0});
    expect_near(program.moves[5].end.tip_mm, {15, 0, 0});
    EXPECT_EQ(program.moves[5].end.axis, (Vec3{1, 0, 0}));
    EXPECT_EQ(program.moves[5].line, 12);
}

TEST(AptMotion, CyclesGoOnWithOtherWords) {
    const std::string from = "SPINDL/1000\nFROM/0,0,50\n";
    const std::string first = "CYCLE/DRILL,DEEP,STEP,20,CLEAR,3,FEDTO,-5,RTRCTO,AUTO,MMPM,250\nGOTO/0,0,0\n";
    const auto expect_same = [&](const std::string& changed, const std::string& whole) {
        const Program a = apt_in_mm(from + first + changed), b = apt_in_mm(from + first + whole);
        ASSERT_EQ(a.moves.size(), b.moves.size());
        for (std::size_t n = 0; n < a.moves.size(); ++n) {
            EXPECT_EQ(a.moves[n].end.tip_mm, b.moves[n].end.tip_mm) << n;
            EXPECT_EQ(a.moves[n].feed_mm_per_min, b.moves[n].feed_mm_per_min) << n;
        }
    };
    expect_same("CYCLE/ON,FEDTO,-7,RTRCTO,AUTO\nGOTO/9,0,0\nCYCLE/ON,STEP,2,MMPM,100\nGOTO/18,0,0\n",
                "CYCLE/DRILL,DEEP,STEP,20,CLEAR,3,FEDTO,-7,RTRCTO,AUTO,MMPM,250\nGOTO/9,0,0\n"
                "CYCLE/DRILL,DEEP,STEP,2,CLEAR,3,FEDTO,-7,MMPM,100\nGOTO/18,0,0\n");
    // Another cycle forgets the changes.
    expect_same("CYCLE/ON,FEDTO,-7\nGOTO/9,0,0\nCYCLE/DRILL,FEDTO,-4,MMPM,50\nCYCLE/ON\nGOTO/18,0,0\n",
                "CYCLE/DRILL,DEEP,STEP,20,CLEAR,3,FEDTO,-7,MMPM,250\nGOTO/9,0,0\n"
                "CYCLE/DRILL,FEDTO,-4,MMPM,50\nGOTO/18,0,0\n");
    expect_same("CYCLE/DRILL,8,MMPM,100,2\nCYCLE/ON,MMPM,60\nGOTO/9,0,0\n",
                "CYCLE/DRILL,8,MMPM,60,2\nGOTO/9,0,0\n");
}

TEST(AptMotion, IncrementsHomesAndRetractions) {
    const Program program = apt_in_mm(
        "FROM/0,0,0\nGODLTA/1,2,3\nTLAXIS/0,0.6,0.8\nGOTO/1,2,3\nGODLTA/-10\nRAPID\nGODLTA/0,0,1\nCLEARP/"
        "XYPLAN,"
        "20\nRETRCT\nRETRCT\nGOHOME/0,0,99,0,0,1\nGOHOME\nGOTO/5,5,5\nGOTO/6,5,5\n");
    ASSERT_EQ(program.moves.size(), 7U);
    expect_near(program.moves[0].end.tip_mm, {1, 2, 3});
    expect_near(program.moves[2].end.tip_mm, {1, -4, -5});
    EXPECT_EQ(program.moves[3].kind, MoveKind::rapid);
    // 24 mm up at 0.8 to the axis.
    expect_near(program.moves[4].end.tip_mm, {1, 14, 20});
    EXPECT_EQ(program.moves[4].kind, MoveKind::rapid);
    expect_near(program.moves[5].end.tip_mm, {0, 0, 99});
    expect_near(program.moves[6].start.tip_mm, {5, 5, 5});
    EXPECT_TRUE(warns_of(program, 14, "only the machine knows"));

    // No plane is known: the path ends, and goes on at the next point.
    const Program open = apt_in_mm("FROM/0,0,0\nGOTO/1,0,0\nRETRCT\nDELAY/2,SEC\nGOTO/5,5,5\nGOTO/6,5,5\n");
    ASSERT_EQ(open.moves.size(), 2U);
    expect_near(open.moves[1].start.tip_mm, {5, 5, 5});
    EXPECT_TRUE(warns_of(open, 5, "RETRCT leads where only the machine knows"));
}

TEST(AptMotion, FramesLeadPointsToThatOfTheProgram) {
    // NX: the second system stands on its side, 100 mm to the right of the first.
    const Program nx = apt_in_mm(
        "MSYS/10,0,0,1,0,0,0,1,0\nFROM/0,0,0\nGOTO/1,2,3\nMSYS/110,0,0,0,1,0,0,0,1\nGOTO/1,2,3\nGODLTA/"
        "1,0,0\n"
        "CIRCLE/0,2,3,0,0,1,2\nGOTO/0,4,3\n");
    ASSERT_EQ(nx.moves.size(), 4U);
    expect_near(nx.moves[0].end.tip_mm, {1, 2, 3});
    expect_near(nx.moves[1].end.tip_mm, {103, 1, 2});
    expect_near(nx.moves[1].end.axis, {1, 0, 0});
    expect_near(nx.moves[2].end.tip_mm, {103, 2, 2});
    expect_near(nx.moves[3].end.tip_mm, {103, 0, 4});
    EXPECT_NEAR(path_length_mm(nx.moves[3]), kPi, 1e-9);
    EXPECT_TRUE(warns_of(nx, 6, "second MSYS"));
    EXPECT_EQ(nx.warnings.size(), 1U);

    const std::string tilted = "CSYS/0,-0.8,-0.6,10,1,0,0,0,0,-0.6,0.8,0\nFROM/0,0,0\nGOTO/0,0,5\n";
    const Program world = apt_in_mm("TRNTYP/WORLD,0,0,0\n" + tilted);
    expect_near(world.moves.at(0).end.tip_mm, {0, 0, 5});
    EXPECT_TRUE(world.warnings.empty());
    const Program local = apt_in_mm("TRNTYP/LOCAL\n" + tilted);
    expect_near(local.moves.at(0).end.tip_mm, {7, 0, 4}, 1e-9);
    expect_near(local.moves.at(0).end.axis, {-0.6, 0, 0.8}, 1e-9);
    EXPECT_TRUE(warns_of(local, 3, "TRNTYP/LOCAL"));

    const Program moved = apt_in_mm("ORIGIN/1,1,1\nTRANS/0,0,5\nFROM/0,0,0\nTRANS/0,0,0\nGOTO/1,0,0\n");
    expect_near(moved.moves.at(0).start.tip_mm, {0, 0, 5});
    expect_near(moved.moves.at(0).end.tip_mm, {1, 0, 0});
    EXPECT_TRUE(warns_of(moved, 3, "ORIGIN"));
    EXPECT_TRUE(warns_of(moved, 4, "TRANS"));
}

TEST(AptMotion, ToolsAndSpeedsInTheSpellingsOfVendors) {
    const Program program = apt_in_mm(
        "TOOL PATH/CAVITY,TOOL,MILL_D10\nTLDATA/MILL,10.0,2.0,75.0,0,0\nPAINT/PATH\nLOAD/TOOL,1\n"
        "SPINDL/SMM,314.15926535897932,CLW,RANGE,2\nFEDRAT/INVERS,AUTO\nTPRINT/T1 End Mill D 10 "
        "$$\nRAPID/MMPM,9000\n"
        "FROM/0,0,0\nGOTO/1,0,0\nAUXFUN/13\nDELAY/5,REV\nCUTCOM/ON,LENGTH,1\nEND-OF-PATH\n");
    ASSERT_EQ(program.moves.size(), 2U);
    EXPECT_NEAR(program.moves[0].spindle_rpm, 10'000, 1e-9);
    EXPECT_EQ(program.moves[0].kind, MoveKind::rapid);  // FROM is no GOTO
    ASSERT_EQ(program.tools.size(), 1U);
    EXPECT_EQ(program.tools[0].diameter_mm, 10);
    EXPECT_EQ(program.tools[0].corner_mm, 2);
    EXPECT_NEAR(program.moves[1].duration_s, 0.03, 1e-12);
    EXPECT_TRUE(warns_of(program, 10, "speed of RAPID"));
    EXPECT_TRUE(warns_of(program, 13, "AUXFUN hands text"));
}

TEST(AptMotion, TakesTheShapeOfToolsFromTldata) {
    const auto tool = [](const std::string& data) {
        const Program program = apt_in_mm("TLDATA/" + data + "\nLOAD/TOOL,1\nGOTO/0,0,0\nGOTO/1,0,0\n");
        return program.tools.empty() ? motion::DeclaredTool{} : program.tools[0];
    };
    // Diameter, corner radius, length, the angles of side and tip.
    const motion::DeclaredTool taper = tool("MILL,4.0,0.0,20.0,5.0,0.0");
    EXPECT_EQ(taper.kind, "taper");
    EXPECT_EQ(taper.tip_mm, 4);
    EXPECT_EQ(taper.taper_deg, 5);
    EXPECT_NEAR(taper.diameter_mm, 4 + 2 * 20 * std::tan(5 * kPi / 180), 1e-9);
    const motion::DeclaredTool pointed = tool("MILL,10.0,0.0,50.0,0.0,45.0");
    EXPECT_EQ(pointed.kind, "drill");
    EXPECT_EQ(pointed.point_deg, 90);
    // Kind of the machine, diameter, corner radius, length, angle of the point, length of the flutes.
    const motion::DeclaredTool drill = tool("DRILL,MILL,8.5,0.0,80.0,118.0,35.0");
    EXPECT_EQ(drill.kind, "drill");
    EXPECT_EQ(drill.diameter_mm, 8.5);
    EXPECT_NEAR(drill.point_deg, 118, 1e-12);
    const Program slot = apt_in_mm("TLDATA/TCUTTER,20.0,0,50,3\nLOAD/TOOL,1\nGOTO/0,0,0\nGOTO/1,0,0\n");
    EXPECT_EQ(slot.tools.at(0).diameter_mm, 20);
    EXPECT_TRUE(warns_of(slot, 3, "another tool than a mill or a drill"));
}

}  // namespace
}  // namespace tribo::readers
