// SPDX-License-Identifier: MIT
// What the CAM systems write: headers in comments, words for post-processors, circles between geometry,
// cycles of Creo and Autodesk, spellings of settings. Paths come from closed forms.
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "readers/apt/apt_text.hpp"

namespace tribo::readers {
namespace {

using motion::Move;
using motion::MoveKind;
using motion::Program;

constexpr const char* kIdentity = "1.0, 0.0, 0.0, 0.0, $\n 0.0, 1.0, 0.0, 0.0, $\n 0.0, 0.0, 1.0, 0.0\n";

TEST(AptVendors, ReadsAProgramOfCreo) {
    const Program program = apt(
        "$$*          Pro/CLfile  Version 9.0\r\n$$-> MFGNO / TEST\r\nPARTNO / TEST\r\n$$-> FEATNO / 25\r\n"
        "MACHIN / UNCX01, 1\r\n$$-> CUTCOM_GEOMETRY_TYPE / OUTPUT_ON_CENTER\r\nUNITS / INCHES\r\n"
        "LOADTL / 1, OSETNO, 1\r\n$$-> CUTTER / 0.500000\r\n$$-> CSYS / " +
        std::string(kIdentity) +
        "SPINDL / RPM, 1000.0,  CLW\r\nCOOLNT / ON\r\nRAPID \r\nGOTO / 1.0, 0.0, 1.0\r\n"
        "FEDRAT / 10.0,  IPM\r\nGOTO / 1.0, 0.0, 0.0\r\n"
        "CIRCLE / 0.0, 0.0, 0.0, $ $$ FIRST ORBIT\r\n$$ between\r\n0.0, 0.0, 1.0, 1.0\r\n"
        "GOTO / 0.0, 1.0, 0.0\r\nGOTO / -1.0, 0.0, 0.0\r\nCUTCOM / LEFT, 2\r\nGOTO / -2.0, 0.0, 0.0\r\n"
        "$$-> END / \r\nFINI\r\n\x1a");
    EXPECT_NEAR(feed_mm(program), (1 + kPi + 1) * 25.4, 1e-9);
    ASSERT_EQ(program.tools.size(), 1U);
    EXPECT_NEAR(program.tools[0].diameter_mm, 12.7, 1e-12);
    EXPECT_EQ(program.tools[0].number, 1);
    ASSERT_EQ(program.warnings.size(), 1U);
    EXPECT_NE(program.warnings[0].text.find("path of the tool's centre"), std::string::npos);
}

TEST(AptVendors, ReadsTheMatrixOfCatiaAndLeadsLaterOnesToIt) {
    const auto header = [](const char* rows) {
        return std::string("$$*CATIA0\n$$ Manufacturing Program.1\n") + rows;
    };
    const std::string first = header("$$ 1.0 0.0 0.0 0.0\n$$ 0.0 1.0 0.0 0.0\n$$ 0.0 0.0 1.0 0.0\n");
    const std::string second = header("$$ 0.0 0.0 1.0 100.0\n$$ 1.0 0.0 0.0 0.0\n$$ 0.0 1.0 0.0 0.0\n");
    const Program same = apt_in_mm(first + "FROM/0,0,0\nGOTO/1,2,3\n" + first + "GOTO/4,5,6\n");
    expect_near(same.moves.at(1).end.tip_mm, {4, 5, 6});
    EXPECT_TRUE(same.warnings.empty());
    // (x, y, z) of the second lies at (100 + z, x, y) of the first.
    const Program other = apt_in_mm(first + "FROM/0,0,0\nGOTO/1,2,3\n" + second + "GOTO/4,5,6\n");
    expect_near(other.moves.at(1).end.tip_mm, {106, 4, 5});
    expect_near(other.moves.at(1).end.axis, {1, 0, 0});
    EXPECT_TRUE(warns_of(other, 10, "a second coordinate system"));
    // Comments of another kind below the name are no matrix.
    const Program lathe = apt_in_mm("$$*CATIA0\n$$ PGM\n$$ text\nFROM/0,0,0\nGOTO/1,2,3\n");
    EXPECT_TRUE(warns_of(lathe, 3, "without its matrix"));
    EXPECT_EQ(lathe.moves.size(), 1U);
}

TEST(AptVendors, ATurnedSystemOfCreoIsThatOfPointsWithoutAnAxis) {
    const std::string start = "$$-> CSYS / " + std::string(kIdentity) + "MULTAX / ON\nFROM/0,0,0\n";
    const std::string turned = "$$-> CSYS / 0,0,1,100, $\n1,0,0,0, $\n0,1,0,0\n";
    const Program local = apt_in_mm(start + turned + "GOTO/4,5,6\nGOTO/5,5,6\n");
    expect_near(local.moves.at(0).end.tip_mm, {106, 4, 5});
    expect_near(local.moves.at(0).end.axis, {1, 0, 0});
    expect_near(local.moves.at(1).end.tip_mm, {106, 5, 5});
    EXPECT_TRUE(warns_of(local, 8, "state no axis"));
    const Program machine = apt_in_mm(start + turned + "GOTO/4,5,6,1,0,0\nGOTO/5,5,6\n");
    expect_near(machine.moves.at(0).end.tip_mm, {4, 5, 6});
    expect_near(machine.moves.at(1).end.tip_mm, {5, 5, 6});
    EXPECT_TRUE(warns_of(machine, 8, "taken as written"));
}

TEST(AptVendors, TransformsAndWorkFramesMoveThePoints) {
    const Program moved = apt_in_mm(
        "FROM/0,0,0\nTRACUT/(MATRIX/TRANSL,10,0,5)\nGOTO/1,2,3\nTRACUT/(MATRIX/XYROT,90)\nGOTO/1,2,3\n"
        "TRACUT/1,0,0,7,0,0,-1,8,0,1,0,9\nGOTO/1,2,3\nTRACUT/NOMORE\nGOTO/1,2,3\n");
    expect_near(moved.moves.at(0).end.tip_mm, {11, 2, 8});
    expect_near(moved.moves.at(1).end.tip_mm, {-2, 1, 3});
    expect_near(moved.moves.at(2).end.tip_mm, {8, 5, 11});
    expect_near(moved.moves.at(2).end.axis, {0, -1, 0});
    expect_near(moved.moves.at(3).end.tip_mm, {1, 2, 3});
    const Program work = apt_in_mm(
        "MCSYS/ NUM, 1, POINT, 0, 0, 0, VECTOR, 1, 0, 0, VECTOR, 0, 1, 0\nFROM/0,0,0\n"
        "MCSYS/ NUM, 2, POINT, 0, 0, 50, VECTOR, 0, 1, 0, VECTOR, 0, 0, 1\nGOTO/1,2,3\n");
    expect_near(work.moves.at(0).end.tip_mm, {3, 1, 52});
    EXPECT_TRUE(warns_of(work, 5, "a second MCSYS"));
}

TEST(AptVendors, PassesOverWordsOfPostProcessors) {
    const Program program = apt_in_mm(
        "PPWORD/1,2,3\nSURFPARMS\nswitch/3\nCSI_SPECIAL-2/4,TEXT\nCHANNEL,1\nFROM/0,0,0\nSWITCH/4\nGOTO/"
        "1,0,0\n"
        "MODE/ABSOL\nROTATE/TABLE,ATANGL,0\nARCSLP/2\nFINI\n");
    EXPECT_EQ(feed_mm(program), 1);
    EXPECT_TRUE(warns_of(program, 3, "'PPWORD' is a word for a post-processor"));
    EXPECT_TRUE(warns_of(program, 4, "'SURFPARMS'"));
    EXPECT_TRUE(warns_of(program, 5, "'switch'"));
    EXPECT_TRUE(warns_of(program, 6, "'CSI_SPECIAL-2'"));
    EXPECT_TRUE(warns_of(program, 7, "'CHANNEL,1'"));
    EXPECT_TRUE(warns_of(program, 13, "rises as its points say"));
    EXPECT_EQ(program.warnings.size(), 6U);
    std::string many = "FROM/0,0,0\nGOTO/1,0,0\n";
    for (char c = 'A'; c < 'A' + 25; ++c) many += std::string("WORD") + c + "\n";
    EXPECT_EQ(apt_in_mm(many).warnings.size(), 21U);
    EXPECT_TRUE(warns_of(apt_in_mm(many), 0, "5 statements"));
}

// The only move's arc: its middle and its length are those of the closed form.
void expect_vendor_arc(const std::string& text, Vec3 middle, double length_mm) {
    SCOPED_TRACE(text);
    const Program program = apt_in_mm(text);
    ASSERT_EQ(program.moves.size(), 1U);
    EXPECT_NEAR(path_length_mm(program.moves[0]), length_mm, 1e-9);
    expect_near(pose_at(program.moves[0], 0.5).tip_mm, middle, 1e-9);
    EXPECT_TRUE(program.warnings.empty());
}

TEST(AptVendors, CirclesBetweenGeometry) {
    const double q = 10 / std::sqrt(2.0), third = 2 * kPi / 3;
    const std::string from = "FROM/10,0,5\n", ahead = from + "INDIRV/0,1,0\n";
    const std::string line = "(LINE/0,0,5,0,10,5)\n";
    expect_vendor_arc(ahead + "TLON, GOFWD / (CIRCLE / 0, 0, 5, 10), ON, (LINE / 0, 0, 5, 0, 10, 5)\n",
                      {q, q, 5}, 5 * kPi);
    expect_vendor_arc(ahead + "TLON,\nGOFWD / (CIRCLE / 0,0,5,10),ON," + line, {q, q, 5}, 5 * kPi);
    expect_vendor_arc(ahead + "TLON,GOFWD/ CIRCLE/ 0,0,5,10,ON,LINE/ 0,0,5,0,10,5\n", {q, q, 5}, 5 * kPi);
    expect_vendor_arc(ahead + "TLON,GOFWD/(CYLNDR/0,0,-7,0,0,-1,10),ON," + line, {q, q, 5}, 5 * kPi);
    expect_vendor_arc(ahead + "TLON,GOFWD/(CIRCLE/CANON,0,0,5,0,0,1,10),ON,(POINT/0,10,5)\n", {q, q, 5},
                      5 * kPi);
    expect_vendor_arc(from + "PSIS/(PLANE/0,0,1,5)\nINDIRP/10,4,5\nTLON,GOFWD/(CIRCLE/0,0,5,10),ON," + line,
                      {q, q, 5}, 5 * kPi);
    // The plane x = -5 cuts the circle at 120 and 240 degrees.
    expect_vendor_arc(ahead + "TLON,GOFWD/(CIRCLE/0,0,5,10),ON,(PLANE/1,0,0,-5)\n",
                      {5, 5 * std::sqrt(3.0), 5}, 10 * third);
    expect_vendor_arc(ahead + "TLON,GOFWD/(CIRCLE/0,0,5,10),ON,2,INTOF,(PLANE/1,0,0,-5)\n",
                      {-5, 5 * std::sqrt(3.0), 5}, 20 * third);
    // In the plane of x and z: square on the tool axis only by the direction.
    expect_vendor_arc("FROM/10,0,0\nINDIRV/0,0,1\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,-10,0,0)\n",
                      {0, 0, 10}, 10 * kPi);
}

TEST(AptVendors, PointsMayCarryTheNormalOfTheSurface) {
    const Program program = apt_in_mm("FROM/0,0,0,0,0,1,0,0,1\nGOTO/1,2,3,0,0.6,0.8,0,0,1\n");
    expect_near(program.moves.at(0).end.tip_mm, {1, 2, 3});
    expect_near(program.moves.at(0).end.axis, {0, 0.6, 0.8});
    EXPECT_TRUE(warns_of(program, 3, "normals of the surface"));
}

// The heights of the ends over one hole, um; rapid ones with an r.
std::string vendor_heights(const std::string& cycle) {
    const Program program = apt_in_mm("SPINDL/1000\nFROM/0,0,50\n" + cycle + "\nGOTO/0,0,0\nCYCLE/OFF\n");
    std::string text;
    for (const Move& move : program.moves) {
        text += (text.empty() ? "" : " ") + std::string(move.kind == MoveKind::rapid ? "r" : "") +
                std::to_string(std::lround(move.end.tip_mm.z * 1000));
    }
    return text;
}

TEST(AptVendors, CyclesOfCreoAndCatia) {
    EXPECT_EQ(vendor_heights("CYCLE / DRILL, DEPTH, 5, MMPM, 80, CLEAR, 4, RAPTO, 3, RETURN, 6"),
              "r6000 r1000 -5000 r6000");
    EXPECT_EQ(vendor_heights("CYCLE / DRILL, DEPTH, 5, MMPM, 80, CLEAR, 4, RETURN, 0"), "r4000 -5000 r4000");
    EXPECT_EQ(vendor_heights("CYCLE / BRKCHP, DEPTH, 5, STEP, 3, MMPM, 80, CLEAR, 4, BACK, 1"),
              "r4000 -3000 r-2000 -5000 r4000");
    EXPECT_EQ(vendor_heights("CYCLE / BORE, DEPTH, 5, MMPM, 80, CLEAR, 4, ORIENT, 90"), "r4000 -5000 4000");
    EXPECT_EQ(vendor_heights("CYCLE / DEEP, 5, 80, MMPM, 3, 4"), "r3000 -4000 r3000 r-3746 -5000 r3000");
    EXPECT_EQ(vendor_heights("CYCLE / DEEPHL, 5, 4, 80, MMPM, 3"), "r3000 -4000 r3000 r-3746 -5000 r3000");
    EXPECT_EQ(vendor_heights("CYCLE / TAP, 5, 80, MMPM, 20, 3"), "r3000 -5000 3000");
    EXPECT_EQ(vendor_heights("CYCLE / BORE9, FEDTO, 5, MMPM, 80, RAPTO, 4"), "r4000 -5000 4000");
    const Program tap =
        apt_in_mm("SPINDL/1000\nFROM/0,0,50\nCYCLE/TAP,DEPTH,5,TPI,20,CLEAR,3\nGOTO/0,0,0\nCYCLE/OFF\n");
    EXPECT_NEAR(tap.moves.at(1).feed_mm_per_min, 1270, 1e-9);
}

TEST(AptVendors, SpellingsOfSettings) {
    const Program program =
        apt("units / inch\nLOADTL/ENDMILL_10\nCUTTER/DISPLY,ON\nSPINDL/1000,RPM,CLW,RANGE,HIGH,LOCK\n"
            "FEDRAT/2,FPM\nFROM/0,0,0\nGOTO/1,0,0\nFEDRAT/0.001,FPR\nGOTO/2,0,0\nDELAY/REV,10\n");
    EXPECT_NEAR(program.moves.at(0).feed_mm_per_min, 609.6, 1e-9);
    EXPECT_NEAR(program.moves.at(1).feed_mm_per_min, 304.8, 1e-9);
    EXPECT_NEAR(program.moves.at(2).duration_s, 0.6, 1e-12);
    EXPECT_TRUE(warns_of(program, 2, "'ENDMILL_10' names a tool"));
    EXPECT_TRUE(warns_of(program, 3, "CUTTER without numbers"));
    EXPECT_TRUE(warns_of(apt_in_mm("TOOLNO/1,TURN,1\nFROM/0,0,0\n"), 3, "a turning tool"));
    EXPECT_NEAR(apt("UNITS/CM\nFEDRAT/1\nFROM/0,0,0\nGOTO/1,0,0\n").moves.at(0).end.tip_mm.x, 10, 1e-12);
    EXPECT_TRUE(warns_of(apt("FROM/0,0,0\nFEDRAT/10,IPM\nGOTO/1,0,0\n"), 2, "write UNITS/INCHES"));
}

}  // namespace
}  // namespace tribo::readers
