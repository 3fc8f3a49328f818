// SPDX-License-Identifier: MIT
// One part of six features, as a Siemens program and as G-code: one path.
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "readers/gcode/reader.hpp"
#include "readers/siemens/siemens_text.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

GcodeOptions with_tool() {
    GcodeOptions options;
    options.tools = {{1, 6}};
    return options;
}

// A word with its number.
std::string word(const char* address, double value) {
    return address + short_decimal(value, 9) + ' ';
}

// The tool at steps of 0.25 mm of the whole path, and at its end.
std::vector<motion::ToolPose> samples_of(const motion::Program& program) {
    std::vector<motion::ToolPose> samples;
    double next = 0, reached = 0;
    for (const motion::Move& move : program.moves) {
        const double length = motion::path_length_mm(move);
        for (; length > 0 && next <= reached + length; next += 0.25) {
            samples.push_back(motion::pose_at(move, (next - reached) / length));
        }
        reached += length;
    }
    samples.push_back(program.moves.back().end);
    return samples;
}

void expect_one_path(const std::string& siemens_text, const std::string& gcode_text) {
    const auto siemens = read_siemens(siemens_text, with_tool());
    ASSERT_TRUE(siemens.has_value()) << siemens.error().text();
    const auto gcode = read_gcode(gcode_text, with_tool());
    ASSERT_TRUE(gcode.has_value()) << gcode.error().text();
    EXPECT_NEAR(feed_mm(*siemens), feed_mm(*gcode), 1e-3);
    EXPECT_NEAR(rapid_mm(*siemens), rapid_mm(*gcode), 1e-3);
    const auto a = samples_of(*siemens), b = samples_of(*gcode);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_LT(distance(a[i].tip_mm, b[i].tip_mm), 1e-3) << i;
        ASSERT_LT(distance(a[i].axis, b[i].axis), 1e-6) << i;
    }
}

const std::string kSiemensStart = "G71 G90 G17 G54\nT1 M6\nG0 X-20 Y0 Z10 S3000 M3\n";
const std::string kGcodeStart = "G21 G90 G17 G54\nT1 M6\nG0 X-20 Y0 Z10 S3000 M3\n";

TEST(SiemensPart, PocketWithCompensation) {
    // The way in lies in line with the first side: there both controls agree.
    const std::string contour = "X40 Y0 F500\nX60\nX80 Y20\nG3 X60 Y40 I-20 J0\nG1 X20\nY20\nX40 Y20\nY30\n";
    expect_one_path(kSiemensStart + "G1 Z-3 F200\nX20 F500\nG41 " + contour + "G40 Y60\nG0 Z10\n",
                    kGcodeStart + "G1 Z-3 F200\nX20 F500\nG41 D1 " + contour + "G40 Y60\nG0 Z10\n");
}

TEST(SiemensPart, BoltCircle) {
    std::string holes = "G99 G81 X30 Y0 Z-8 R2 F100\n";
    for (const double deg : {60, 120, 180, 240, 300}) {
        holes += word("X", 30 * std::cos(deg * kPi / 180)) + word("Y", 30 * std::sin(deg * kPi / 180)) + "\n";
    }
    expect_one_path(
        kSiemensStart + "G0 X30\nZ2\nF100\nMCALL CYCLE81(2,0,2,-8)\nHOLES2(0,0,30,0,60,6)\nMCALL\n",
        kGcodeStart + "G0 X30\nZ2\n" + holes + "G80\n");
}

TEST(SiemensPart, TiltedPlane) {
    const double c = std::cos(kPi / 6), s = std::sin(kPi / 6);
    std::string lines = "G43.5\n";
    const auto at = [&](double x, double y, double z) {
        return word("X", 10 + c * x + s * z) + word("Y", 5 + y) + word("Z", c * z - s * x) + word("I", s) +
               word("K", c) + "\n";
    };
    lines += "G0 " + at(0, 0, 20) + "G1 F300 " + at(0, 0, -1) + at(30, 0, -1) + at(30, 20, -1);
    expect_one_path(
        "G71 G90 G17 G54\nT1 M6\nS3000 M3\nCYCLE800(0,\"T\",0,57,10,5,0,0,30,0,0,0,0,-1)\nG0 X0 Y0 Z20\nG1 "
        "Z-1 F300\nX30\nY20\n",
        "G21 G90 G17 G54\nT1 M6\nS3000 M3\n" + lines);
}

TEST(SiemensPart, Loop) {
    expect_one_path(kSiemensStart +
                        "G0 X0 Y0\nR1=1\nWHILE R1<=5\nG1 X=10+R1 F400\nG3 X=IC(0) Y=IC(4) CR=2\nG1 "
                        "X0\nR1=R1+1\nENDWHILE\n",
                    kGcodeStart +
                        "G0 X0 Y0\no1 repeat [5]\n#1=[#1+1]\nG1 X[10+#1] F400\nG91 G3 X0 Y4 R2\nG90 G1 "
                        "X0\no1 endrepeat\n");
}

TEST(SiemensPart, Spline) {
    expect_one_path(
        kSiemensStart + "G0 X0 Y0\nF300\nBSPLINE SD=2 X10 Y20\nX20 Y0\nX30 Y20 PW=2\nX40 Y0\nG1 X50\n",
        kGcodeStart + "G0 X0 Y0\nF300\nG5.2 X10 Y20 L3\nX20 Y0 P1\nX30 Y20 P2\nX40 Y0 P1\nG5.3\nG1 X50\n");
}

TEST(SiemensPart, FiveAxisSwarf) {
    std::string siemens = "TRAORI\n", gcode = "G43.5\n";
    for (int i = 0; i <= 12; ++i) {
        const double rad = i * kPi / 18, x = 40 * std::cos(rad), y = 40 * std::sin(rad);
        const std::string place = "G1 " + word("X", x) + word("Y", y) + "Z-5 F600 ";
        const double u = 0.2 * std::cos(rad), v = 0.2 * std::sin(rad);
        siemens += place + word("A3=", u) + word("B3=", v) + "C3=1\n";
        gcode += place + word("I", u) + word("J", v) + "K1\n";
    }
    expect_one_path(kSiemensStart + siemens, kGcodeStart + gcode);
}

}  // namespace
}  // namespace tribo::readers
