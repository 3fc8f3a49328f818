// SPDX-License-Identifier: MIT
// One part of six features, as a Siemens, a Heidenhain and a Fanuc macro program and as APT: one path.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "readers/apt/reader.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/heidenhain/reader.hpp"
#include "readers/one_path.hpp"
#include "readers/program_checks.hpp"
#include "readers/siemens/reader.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

// The part in each language, without the lines that begin a program.
struct Feature {
    std::string siemens, heidenhain, fanuc, apt;
};

const std::string kSiemensStart = "G71 G90 G17 G54\nT1 M6\nS3000 M3\n";
const std::string kHeidenhainStart = "BEGIN PGM PART MM\nTOOL CALL 1 Z S3000\nM3\n";
const std::string kFanucStart = "O0001\nG21 G90 G17 G54\nT1 M6\nS3000 M3\n";
const std::string kAptStart = "PARTNO PART\nUNITS/MM\nCUTTER/6\nLOADTL/1\nSPINDL/3000,CLW\n";

std::string number(double value) {
    return short_decimal(value, 9);
}
// A word with its number.
std::string word(const char* address, double value) {
    return address + number(value) + ' ';
}
// The same as conversational programs write it.
std::string signed_word(const char* address, double value) {
    return std::string(address) + (value < 0 ? "" : "+") + number(value) + ' ';
}
std::string apt_point(double x, double y, double z) {
    return "GOTO/" + number(x) + "," + number(y) + "," + number(z) + "\n";
}

void expect_one_part(const Feature& feature, double feed_length_mm) {
    GcodeOptions options;
    options.tools = {{1, 6}};
    const auto siemens = read_siemens(kSiemensStart + feature.siemens, options);
    ASSERT_TRUE(siemens.has_value()) << siemens.error().text();
    EXPECT_NEAR(feed_mm(*siemens), feed_length_mm, 2e-3);
    expect_one_path(*siemens, read_heidenhain(kHeidenhainStart + feature.heidenhain, options), "Heidenhain");
    options.dialect = GcodeDialect::fanuc;
    expect_one_path(*siemens, read_gcode(kFanucStart + feature.fanuc, options), "Fanuc");
    expect_one_path(*siemens, read_apt(kAptStart + feature.apt, {}), "APT");
}

TEST(PartInFourLanguages, PocketWithCompensation) {
    // The way in and out lies in line with the sides: there all controls agree.
    const Feature feature{
        "G0 X0 Y0 Z10\nG1 Z-3 F200\nG41 X20 F500\nX60\nG3 X80 Y20 CR=20\nG1 Y40\nG3 X60 Y60 I-20 J0\nG1 X20\n"
        "G40 X0\nG0 Z10\n",
        "L X+0 Y+0 Z+10 FMAX\nL Z-3 F200\nL X+20 RL F500\nL X+60\nCR X+80 Y+20 R+20 DR+\nL Y+40\nCC X+60 "
        "Y+40\n"
        "C X+60 Y+60 DR+\nL X+20\nL X+0 R0\nL Z+10 FMAX\n",
        "G0 X0 Y0 Z10\nG1 Z-3 F200\nG41 D1 X20 F500\nX60\nG3 X80 Y20 R20\nG1 Y40\nG3 X60 Y60 I-20 J0\nG1 "
        "X20\n"
        "G40 X0\nG0 Z10\n",
        // Its points are those of the tool's centre, 3 mm inside.
        "RAPID\nGOTO/0,0,10\nFEDRAT/200,MMPM\nGOTO/0,0,-3\nFEDRAT/500,MMPM\nGOTO/20,3,-3\nGOTO/60,3,-3\n"
        "CIRCLE/60,20,-3,0,0,1,17\nGOTO/77,20,-3\nGOTO/77,40,-3\nCIRCLE/60,40,-3,0,0,1,17\nGOTO/60,57,-3\n"
        "GOTO/20,57,-3\nGOTO/0,60,-3\nRAPID\nGOTO/0,60,10\n"};
    expect_one_part(feature, 13 + 2 * std::hypot(20, 3) + 80 + 20 + 17 * kPi);
}

TEST(PartInFourLanguages, BoltCircle) {
    std::string apt = "RAPID\nGOTO/30,0,2\nCYCLE/DRILL,DEPTH,8,MMPM,100,CLEAR,2\n";
    for (int i = 0; i < 6; ++i) {
        apt += apt_point(30 * std::cos(i * kPi / 3), 30 * std::sin(i * kPi / 3), 0);
    }
    const Feature feature{
        "G0 X30 Y0 Z2\nF100\nMCALL CYCLE81(2,0,2,-8)\nHOLES2(0,0,30,0,60,6)\nMCALL\n",
        "L X+30 Y+0 Z+2 FMAX\nCYCL DEF 200 DRILLING ~\nQ200=2 ~\nQ201=-8 ~\nQ206=100 ~\nQ202=8 ~\nQ210=0 ~\n"
        "Q203=0 ~\nQ204=2 ~\nQ211=0\nPATTERN DEF CIRC1 (X+0 Y+0 D60 START+0 NUM6 Z+0)\nCYCL CALL PAT FMAX\n",
        "G0 X30 Y0 "
        "Z2\n#1=0\nWHILE[#1LT6]DO1\nG99G81X[30*COS[60*#1]]Y[30*SIN[60*#1]]Z-8R2F100\n#1=#1+1\nEND1\n"
        "G80\n",
        apt + "CYCLE/OFF\n"};
    expect_one_part(feature, 6 * 10);
}

TEST(PartInFourLanguages, TiltedPlane) {
    // Tilted by 30 degrees about Y, at X10 Y5.
    const double c = std::cos(kPi / 6), s = std::sin(kPi / 6);
    const auto at = [&](double x, double y, double z) {
        return "GOTO/" + number(10 + c * x + s * z) + "," + number(5 + y) + "," + number(c * z - s * x) +
               "," + number(s) + ",0," + number(c) + "\n";
    };
    const Feature feature{
        "CYCLE800(0,\"T\",0,57,10,5,0,0,30,0,0,0,0,-1)\nG0 X0 Y0 Z20\nG1 Z-1 F300\nX30\nG3 Y20 CR=10\n",
        "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 Y+5\n"
        "PLANE SPATIAL SPA+0 SPB+30 SPC+0 TURN FMAX\nL X+0 Y+0 Z+20 FMAX\nL Z-1 F300\nL X+30\n"
        "CR Y+20 R+10 DR+\n",
        "G68.2 X10 Y5 Z0 I90 J30 K-90\nG53.1\nG0 X0 Y0 Z20\nG1 Z-1 F300\nX30\nG3 Y20 R10\n",
        "MULTAX/ON\nRAPID\n" + at(0, 0, 20) + "FEDRAT/300,MMPM\n" + at(0, 0, -1) + at(30, 0, -1) + "CIRCLE/" +
            number(10 + c * 30 - s) + ",15," + number(-c - s * 30) + "," + number(s) + ",0," + number(c) +
            ",10\n" + at(30, 20, -1)};
    expect_one_part(feature, 21 + 30 + 10 * kPi);
}

TEST(PartInFourLanguages, Loop) {
    std::string apt = "RAPID\nGOTO/0,0,0\nFEDRAT/400,MMPM\n";
    for (int i = 1; i <= 5; ++i) {
        const double y = 4.0 * (i - 1);
        apt += apt_point(10 + i, y, 0) + "CIRCLE/" + number(10 + i) + "," + number(y + 2) + ",0,0,0,1,2\n" +
               apt_point(10 + i, y + 4, 0) + apt_point(0, y + 4, 0);
    }
    const Feature feature{
        "G0 X0 Y0 Z0\nR1=1\nWHILE R1<=5\nG1 X=10+R1 F400\nG3 X=IC(0) Y=IC(4) CR=2\nG1 "
        "X0\nR1=R1+1\nENDWHILE\n",
        "L X+0 Y+0 Z+0 FMAX\nFN 0: Q1 = +1\nLBL 1\nQ2 = 10 + Q1\nL X+Q2 F400\nCR IX+0 IY+4 R+2 DR+\nL X+0\n"
        "FN 1: Q1 = +Q1 + +1\nFN 12: IF +Q1 LT +6 GOTO LBL 1\n",
        "G0 X0 Y0 Z0\n#1=1\nN10 IF[#1GT5]GOTO20\nG1X[10+#1]F400\nG91G3X0Y4R2\nG90G1X0\n#1=#1+1\nGOTO10\n"
        "N20M30\n",
        apt};
    expect_one_part(feature, 5 * (2 * 13 + 2 * kPi));
}

// A rational curve of second degree over 0 to 2, with knots 0 0 0 1 2 2 2 (De Boor 1972).
Vec3 curve_at(double u) {
    const Vec3 points[] = {{0, 0, 0}, {10, 20, 0}, {20, 0, 0}, {30, 20, 0}};
    const double weights[] = {1, 1, 1, 2}, knots[] = {0, 0, 0, 1, 2, 2, 2};
    const std::size_t span = u < 1 ? 2 : 3;
    Vec3 p[3];
    double w[3];
    for (std::size_t i = 0; i < 3; ++i) {
        w[i] = weights[span - 2 + i];
        p[i] = w[i] * points[span - 2 + i];
    }
    for (std::size_t level = 1; level <= 2; ++level) {
        for (std::size_t i = 2; i >= level; --i) {
            const double low = knots[span - 2 + i], high = knots[span + 1 + i - level];
            const double t = (u - low) / (high - low);
            p[i] = (1 - t) * p[i - 1] + t * p[i];
            w[i] = (1 - t) * w[i - 1] + t * w[i];
        }
    }
    return p[2] / w[2];
}

double distance_to_lines(Vec3 p, const motion::Program& program) {
    double least = std::numeric_limits<double>::infinity();
    for (const motion::Move& move : program.moves) {
        const Vec3 from = move.start.tip_mm, way = move.end.tip_mm - from;
        const double along = std::clamp(dot(p - from, way) / squared_length(way), 0.0, 1.0);
        least = std::min(least, distance(p, from + along * way));
    }
    return least;
}

TEST(PartInFourLanguages, Spline) {
    Feature feature{
        "G0 X0 Y0 Z0\nF300\nBSPLINE SD=2 X10 Y20\nX20 Y0\nX30 Y20 PW=2\nG1 X50\n",
        "L X+0 Y+0 Z+0 FMAX\n",
        "G0 X0 Y0 Z0\nG1 F300\n",
        "RAPID\nGOTO/0,0,0\nFEDRAT/300,MMPM\n",
    };
    // The other languages have the points of the curve.
    constexpr int count = 4000;
    double length = 20;
    for (int i = 1; i <= count; ++i) {
        const Vec3 p = curve_at(2.0 * i / count);
        length += distance(p, curve_at(2.0 * (i - 1) / count));
        feature.heidenhain +=
            "L " + signed_word("X", p.x) + signed_word("Y", p.y) + (i == 1 ? "F300\n" : "\n");
        feature.fanuc += word("X", p.x) + word("Y", p.y) + "\n";
        feature.apt += apt_point(p.x, p.y, 0);
    }
    feature.heidenhain += "L X+50\n";
    feature.fanuc += "X50\n";
    feature.apt += "GOTO/50,20,0\n";
    const auto siemens = read_siemens(kSiemensStart + feature.siemens);
    ASSERT_TRUE(siemens.has_value()) << siemens.error().text();
    GcodeOptions fanuc;
    fanuc.dialect = GcodeDialect::fanuc;
    const Result<motion::Program> others[] = {read_heidenhain(kHeidenhainStart + feature.heidenhain),
                                              read_gcode(kFanucStart + feature.fanuc, fanuc),
                                              read_apt(kAptStart + feature.apt)};
    for (const auto& other : others) {
        ASSERT_TRUE(other.has_value()) << other.error().text();
        EXPECT_NEAR(feed_mm(*other), length, 1e-3);
        EXPECT_NEAR(feed_mm(*siemens), length, 1e-3);
        for (const motion::ToolPose& sample : samples_of(*siemens)) {
            ASSERT_LT(distance_to_lines(sample.tip_mm, *other), 1e-3);
        }
    }
}

TEST(PartInFourLanguages, FiveAxisSwarf) {
    Feature feature{"G0 X40 Y0 Z10\nTRAORI\n", "L X+40 Y+0 Z+10 FMAX\n", "G0 X40 Y0 Z10\nG43.5 H1\n",
                    "RAPID\nGOTO/40,0,10\nFEDRAT/600,MMPM\nMULTAX/ON\n"};
    double length = 15;
    for (int i = 0; i <= 12; ++i) {
        const double rad = i * kPi / 18, x = 40 * std::cos(rad), y = 40 * std::sin(rad);
        const double u = 0.2 * std::cos(rad), v = 0.2 * std::sin(rad);
        if (i > 0) length += 80 * std::sin(kPi / 36);
        const std::string place = "G1 " + word("X", x) + word("Y", y) + "Z-5 F600 ";
        feature.siemens += place + word("A3=", u) + word("B3=", v) + "C3=1\n";
        feature.fanuc += place + word("I", u) + word("J", v) + "K1\n";
        feature.heidenhain += "LN " + signed_word("X", x) + signed_word("Y", y) + "Z-5 " +
                              signed_word("TX", u) + signed_word("TY", v) + "TZ+1 F600\n";
        feature.apt += "GOTO/" + number(x) + "," + number(y) + ",-5," + number(u) + "," + number(v) + ",1\n";
    }
    expect_one_part(feature, length);
}

// A boring mill: the quill W beside Z. APT knows the tip alone.
TEST(PartInFourLanguages, AxesBesideXYZ) {
    const Feature feature{
        "G0 X0 Y0 Z10\nG0 W-5\nG1 Z-2 F300\nX20 W-6\nG91 U2 W2 Y3\nG90 U0\nW0\nG0 Z10\n",
        "L X+0 Y+0 Z+10 R0 FMAX\nL W-5 R0 FMAX\nL Z-2 F300\nL X+20 W-6\nL IU+2 IW+2 IY+3\nL U+0\nL W+0\nL "
        "Z+10 FMAX\n",
        "G0 X0 Y0 Z10\nG0 W-5\nG1 Z-2 F300\nX20 W-6\nG91 U2 W2 Y3\nG90 U0\nW0\nG0 Z10\nM30\n",
        "RAPID\nGOTO/0,0,10\nRAPID\nGOTO/0,0,5\nFEDRAT/300,MMPM\nGOTO/0,0,-7\nGOTO/20,0,-8\nGOTO/22,3,-6\n"
        "GOTO/20,3,-6\nGOTO/20,3,-2\nRAPID\nGOTO/20,3,10\n"};
    expect_one_part(feature, 12 + std::sqrt(401.0) + std::sqrt(17.0) + 2 + 4);
}

}  // namespace
}  // namespace tribo::readers
