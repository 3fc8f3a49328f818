// SPDX-License-Identifier: MIT
// TRACYL, TRANSMIT, frames as values, and pockets within contours, each against other words or a closed form.
#include <cmath>
#include <gtest/gtest.h>

#include "motion/machine/machine.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/siemens/siemens_text.hpp"

namespace tribo::readers {
namespace {

motion::Program on(const char* name, std::string_view text) {
    const motion::Machine machine = *motion::named_machine(name);
    GcodeOptions options;
    options.machine = &machine;
    options.tools = {{1, 10}};
    return siemens(text, options);
}

std::string fault(std::string_view text, const char* name = nullptr) {
    const motion::Machine machine = *motion::named_machine(name == nullptr ? "xyza" : name);
    GcodeOptions options;
    options.source_name = "p.mpf";
    options.machine = name == nullptr ? nullptr : &machine;
    const auto program = read_siemens(std::string(kSiemensStart) + std::string(text), options);
    return program ? "" : program.error().text();
}

TEST(SiemensCylinder, RollsThePlaneAboutTheAxis) {
    // At a radius of 25 a place (x, y) of the plane lies at the angle y / 25 from the top.
    const motion::Program program =
        on("xyza", "F300\nTRACYL(50)\nG0 X0 Y0 Z25\nG1 X10 Y20\nG1 Y-30\nTRAFOOF\nG0 Z50\n");
    std::vector<Vec3> ends;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed) ends.push_back(move.end.tip_mm);
    }
    ASSERT_FALSE(ends.empty());
    const auto on_cylinder = [](double x, double y, double z) {
        return Vec3{x, z * std::sin(y / 25), z * std::cos(y / 25)};
    };
    expect_near(ends.back(), on_cylinder(10, -30, 25), 1e-9);
    for (const motion::Move& move : program.moves) {
        if (move.kind != motion::MoveKind::feed) continue;
        for (const double t : {0.0, 0.3, 1.0}) {
            const Vec3 tip = motion::pose_at(move, t).tip_mm;
            EXPECT_NEAR(math::hypot(tip.y, tip.z), 25, 2e-4);
        }
    }
    // F counts along the surface.
    double time_s = 0;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed)
            time_s += 60 * motion::path_length_mm(move) / move.feed_mm_per_min;
    }
    EXPECT_NEAR(time_s, (std::hypot(10, 20) + 50) / 300 * 60, 1e-3);
    // After it the table stays where it is.
    expect_near(end_of(program), on_cylinder(10, -30, 50), 1e-9);
}

TEST(SiemensCylinder, IsThatOfFanuc) {
    // The table of this machine turns against the coordinate: A is -y / 25, and the plane of G7.1 is seen in
    // a mirror.
    const motion::Program rolled = on("xyza",
                                      "F300\nTRACYL(50)\nG0 X0 Y0 Z25\nG1 X10 Y20\nG3 X20 Y30 CR=10\n"
                                      "G2 X30 Y20 CR=10\n");
    const motion::Machine machine = *motion::named_machine("xyza");
    GcodeOptions options;
    options.machine = &machine;
    options.dialect = GcodeDialect::fanuc;
    const auto degrees = [](double y) { return std::to_string(-y / 25 * 180 / kPi); };
    const auto other = read_gcode(
        "G21 G90 G17 G94 M3 S3000 F300\nG0 X0 Y0 Z10\nG0 X0 Y0 Z25 A0\nG7.1 A25\nG1 X10 A" + degrees(20) +
            "\nG2 X20 A" + degrees(30) + " R10\nG3 X30 A" + degrees(20) + " R10\nG7.1 A0\n",
        options);
    ASSERT_TRUE(other.has_value()) << other.error().text();
    EXPECT_NEAR(feed_mm(rolled), feed_mm(*other), 1e-3);
    EXPECT_LT(apart_mm(rolled, *other), 1e-3);
}

TEST(SiemensCylinder, CompensatesAndMillsPocketsInThePlane) {
    // A square of 20 outside: the offset path and its corners are those of the plane.
    const std::string square = "G41 G1 X0 Y0\nY20\nX20\nY0\nX0\nG40 X-20 Y-20\n";
    const motion::Program flat = on("xyza", "F300\nG0 X-20 Y-20 Z25\n" + square);
    const motion::Program rolled = on("xyza", "F300\nTRACYL(50)\nG0 X-20 Y-20 Z25\n" + square);
    EXPECT_NEAR(feed_mm(rolled), feed_mm(flat), 1e-2);
    EXPECT_GT(apart_mm(rolled, flat), 1);
}

TEST(SiemensCylinder, NeedsATableThatTurnsThere) {
    EXPECT_NE(fault("TRACYL(0)\n", "xyza").find("without the diameter"), std::string::npos);
    EXPECT_NE(fault("TRACYL(40)\n", "head-head").find("no table that turns about X or Y"), std::string::npos);
    EXPECT_NE(fault("TRACYL(40)\n", "head-table").find("no table that turns about X or Y"),
              std::string::npos);
    EXPECT_NE(fault("TRACYL(40)\nG0 A10\n", "xyza").find("A is turned by TRACYL"), std::string::npos);
    EXPECT_NE(fault("TRACYL(40,1,1)\n", "xyza").find("groove's wall"), std::string::npos);
    EXPECT_TRUE(warns_of(siemens("F100\nTRACYL(40)\nG1 X5\n"), 5, "without a machine"));
}

TEST(SiemensTransmit, MovesInThePart) {
    const std::string path = "F100\nG1 X10 Y5\nG3 X20 Y15 CR=10\n";
    const motion::Program plain = siemens(path), polar = siemens("TRANSMIT\n" + path + "TRAFOOF\n");
    EXPECT_LT(apart_mm(plain, polar), 1e-12);
    EXPECT_TRUE(warns_of(polar, 4, "X and Y are taken as those of the part"));
}

TEST(SiemensFrames, AreValues) {
    const std::string path = "F100\nG0 X0 Y0 Z0\nG1 X10 Y5\nX20\n";
    const motion::Program plain = siemens("TRANS X10 Y5\nAROT Z30\n" + path);
    for (const char* words :
         {"$P_PFRAME=CTRANS(X,10,Y,5):CROT(Z,30)\n", "$P_UIFR[1]=CTRANS(X,10,Y,5):CROT(Z,30)\n",
          "$P_BFRAME=CTRANS(X,10,Y,5):CROT(Z,30)\n", "$P_CHBFR[0]=CTRANS(X,10,Y,5)\n$P_UIFR[1]=CROT(Z,30)\n",
          "DEF FRAME F1\nF1=CTRANS(X,10,Y,5)\n$P_PFRAME=F1:CRPL(0,30)\n",
          "DEF FRAME F1=CROT(Z,30)\n$P_UIFR[2]=CTRANS(X,10,Y,5)\n$P_PFRAME=$P_UIFR[2]:F1\n",
          "$P_PFRAME[X,TR]=10\n$P_PFRAME[Y,TR]=5\n$P_PFRAME[Z,RT]=30\n",
          "$P_UIFR[1,X,TR]=10\n$P_UIFR[1,Y,TR]=5\n$P_UIFR[1,Z,RT]=30\n"})
        EXPECT_LT(apart_mm(plain, siemens(words + path)), 1e-9) << words;
    // The last frame replaces the one before it.
    EXPECT_LT(
        apart_mm(plain, siemens("$P_PFRAME=CTRANS(X,99)\n$P_PFRAME=CTRANS(X,10,Y,5):CROT(Z,30)\n" + path)),
        1e-9);
    EXPECT_NE(fault("$P_ACTFRAME=CTRANS(X,2)\n").find("is not read"), std::string::npos);
}

TEST(SiemensFrames, ScaleAndMirrorAsTheirBlocksDo) {
    const std::string path = "F100\nG0 X0 Y0 Z0\nG1 X10 Y5\nG2 X20 Y15 CR=20\n";
    const struct {
        const char* value;
        const char* blocks;
    } cases[] = {
        {"$P_PFRAME=CTRANS(X,10):CSCALE(X,2,Y,2):CTRANS(Y,3):CROT(Z,30)\n",
         "TRANS X10\nASCALE X2 Y2\nATRANS Y3\nAROT Z30\n"},
        {"$P_PFRAME=CTRANS(X,10):CMIRROR(X):CTRANS(X,3):CROT(Z,30)\n",
         "TRANS X10\nAMIRROR X0\nATRANS X3\nAROT Z30\n"},
        {"TRANS X10\n$P_PFRAME=$P_PFRAME:CMIRROR(X)\n$P_PFRAME=$P_PFRAME:CTRANS(X,3)\n",
         "TRANS X10\nAMIRROR X0\nATRANS X3\n"},
        {"TRANS X10\n$P_PFRAME[X,SC]=2\n$P_PFRAME[Y,SC]=2\n$P_PFRAME[Y,MI]=1\n",
         "TRANS X10\nASCALE X2 Y2\nAMIRROR Y0\n"},
    };
    for (const auto& c : cases)
        EXPECT_LT(apart_mm(siemens(c.blocks + path), siemens(c.value + path)), 1e-9) << c.value;
    // X of the image: 10 - 10.
    expect_near(
        siemens("F100\n$P_PFRAME=CTRANS(X,10):CMIRROR(X)\nG0 X0 Y0 Z0\nG1 X10\n").moves.back().end.tip_mm,
        {0, 0, 0});
    EXPECT_NE(fault("$P_PFRAME=CSCALE(X,0)\n").find("0.001 to 1000"), std::string::npos);
}

double fed_at(const motion::Program& program, double z) {
    double sum = 0;
    for (const motion::Move& move : program.moves) {
        const bool lies = move.start.tip_mm.z == z && move.end.tip_mm.z == z;
        if (lies && move.kind == motion::MoveKind::feed) sum += motion::path_length_mm(move);
    }
    return sum;
}

motion::Program transformed(std::string_view text) {
    GcodeOptions options;
    options.tools = {{1, 10}};
    return siemens(text, options);
}

TEST(SiemensContourPockets, AreFilledWithRings) {
    const std::string contour = "M30\nEDGE_A:\nG1 X0 Y0\nX60\nY40\nX0\nY0\nEDGE_E:\n";
    const motion::Program program = transformed(
        "CYCLE62(,2,\"EDGE_A\",\"EDGE_E\")\n"
        "CYCLE63(\"P1\",1,20,0,2,-4,300,100,5,2,0,0,0,,,,,,1,2,,,,0,201,0)\n" +
        contour);
    for (const double z : {-2.0, -4.0})
        EXPECT_NEAR(fed_at(program, z), 40 + 80 + 120 + 160 + 3 * std::hypot(5, 5), 1e-4) << z;
    EXPECT_EQ(end_of(program).z, 20);
    // The same with the step in percent of the tool and the depth from the surface on.
    const motion::Program percent = transformed(
        "CYCLE62(,2,\"EDGE_A\",\"EDGE_E\")\n"
        "CYCLE63(\"P1\",1,20,0,2,4,300,100,50,2,0,0,0,,,,,,1,2,,,,0,201,11)\n" +
        contour);
    EXPECT_LT(apart_mm(program, percent), 1e-9);
    // Its edge alone.
    const motion::Program edge = transformed(
        "CYCLE62(,2,\"EDGE_A\",\"EDGE_E\")\n"
        "CYCLE63(\"P1\",4,20,0,2,-4,300,100,5,4,1,0,0,,,,,,1,2,,,,0,201,0)\n" +
        contour);
    EXPECT_NEAR(fed_at(edge, -4), 160, 1e-6);
}

TEST(SiemensContourPockets, HaveIslands) {
    const motion::Program program = transformed(
        "CYCLE62(,2,\"EDGE_A\",\"EDGE_E\")\nCYCLE62(,2,\"ISLE_A\",\"ISLE_E\")\n"
        "CYCLE63(\"P1\",1,20,0,2,-4,300,100,5,4,0,0,1,,,,,,1,2,,,,0,201,0)\nM30\n"
        "EDGE_A:\nG1 X0 Y0\nX60\nY40\nX0\nY0\nEDGE_E:\n"
        "ISLE_A:\nG1 X25 Y20\nG2 X35 Y20 CR=5\nG2 X25 Y20 CR=5\nISLE_E:\n");
    double nearest = 1e9;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed)
            nearest = std::min(nearest, math::hypot(move.end.tip_mm.x - 30, move.end.tip_mm.y - 20));
    }
    EXPECT_NEAR(nearest, 10, 1e-6);
}

TEST(SiemensCycles, PolygonsHaveEqualSides) {
    const double side = 2 * 20 * std::tan(kPi / 6);
    const motion::Program hexagon =
        transformed("CYCLE79(20,0,2,-5,6,40,50,40,0,0,0,5,5,0,0,300,0,1,0,0,0,0,0)\n");
    EXPECT_NEAR(fed_at(hexagon, -5), 6 * side + 2 * kPi * 5 + 2 * 5, 1e-9);
    // A round blank of 60: rings of 5 mm, the second one at the first's distance and 5.
    const motion::Program blank =
        transformed("CYCLE79(20,0,2,-5,6,40,50,40,0,0,60,5,5,0,0,300,0,1,0,0,0,0,0)\n");
    EXPECT_NEAR(fed_at(blank, -5), 2 * 6 * side + 2 * kPi * (5 + 10) + 5 + 10 + 15, 1e-9);
}

}  // namespace
}  // namespace tribo::readers
