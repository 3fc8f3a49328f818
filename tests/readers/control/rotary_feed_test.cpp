// SPDX-License-Identifier: MIT
// What the feed of a turning move counts on each control, and speeds that no machine has.
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "readers/gcode/reader.hpp"
#include "readers/heidenhain/reader.hpp"
#include "readers/siemens/reader.hpp"

namespace tribo::readers {
namespace {

constexpr double kPi = 3.14159265358979323846;

GcodeOptions on(const motion::Machine& machine) {
    GcodeOptions options;
    options.source_name = "p";
    options.machine = &machine;
    return options;
}

// Time of the moves at feed of a program in a language, s.
double feed_s(const Result<motion::Program>& program) {
    EXPECT_TRUE(program) << (program ? "" : program.error().cause);
    double sum = 0;
    if (!program) return sum;
    for (const motion::Move& move : program->moves) {
        if (move.kind != motion::MoveKind::feed) continue;
        sum +=
            move.duration_s > 0 ? move.duration_s : 60 * motion::path_length_mm(move) / move.feed_mm_per_min;
    }
    return sum;
}

bool warns(const motion::Program& program, std::string_view text) {
    for (const Warning& warning : program.warnings) {
        if (warning.text.find(text) != std::string::npos) return true;
    }
    return false;
}

const motion::Machine kTable = *motion::named_machine("xyzac-trt");

double gcode_s(const std::string& text, GcodeDialect dialect) {
    GcodeOptions options = on(kTable);
    options.dialect = dialect;
    return feed_s(read_gcode(text, options));
}

TEST(RotaryFeed, of_linuxcnc_counts_lengths_or_else_degrees) {
    const std::string start = "G21 G90 M3 S1000\nG0 X0 Y5 Z0 A0 C0\n";
    EXPECT_NEAR(gcode_s(start + "G1 C90 F360\n", GcodeDialect::linuxcnc), 15, 1e-9);
    EXPECT_NEAR(gcode_s(start + "G1 X20 C40 F300\n", GcodeDialect::linuxcnc), 4, 1e-9);  // 20 mm alone
    // In inches F of a turn counts degrees too.
    EXPECT_NEAR(gcode_s("G20 G90 M3 S1000\nG0 X0 Y5 Z0 A0 C0\nG1 C90 F360\n", GcodeDialect::linuxcnc), 15,
                1e-9);
}

TEST(RotaryFeed, of_fanuc_counts_a_degree_as_a_millimetre) {
    // The example of the manual (B-63174EN, 4.2): 0.14907 min.
    const std::string start = "G21 G90 M3 S1000\nG0 X0 Y5 Z0 A0 C0\n";
    EXPECT_NEAR(gcode_s(start + "G91 G1 X20.0 C40.0 F300.0\n", GcodeDialect::fanuc), 60 * 0.14907, 1e-3);
    EXPECT_NEAR(gcode_s(start + "G1 C90. F360.\n", GcodeDialect::fanuc), 15, 1e-9);
    // In inches a degree counts as an inch: the root of 2^2 + 40^2, at 30 a minute.
    EXPECT_NEAR(gcode_s("G20 G90 M3 S1000\nG0 X0 Y5 Z0 A0 C0\nG1 X2. C40. F30.\n", GcodeDialect::fanuc),
                60 * std::sqrt(4 + 1600) / 30, 1e-6);
    GcodeOptions options = on(kTable);
    options.dialect = GcodeDialect::fanuc;
    EXPECT_TRUE(warns(*read_gcode(start + "G1 C90. F360.\n", options), "settings 34 and 79"));
    EXPECT_NEAR(gcode_s(start + "G93\nG1 X20. C40. F2.\n", GcodeDialect::fanuc), 30, 1e-9);
}

TEST(RotaryFeed, of_heidenhain_is_that_of_the_tip_with_m116) {
    const std::string start = "0 BEGIN PGM P MM\n1 L X+50 Y+0 Z+0 C+0 R0 FMAX M3\n";
    const auto time_s = [&](const std::string& blocks) {
        return feed_s(read_heidenhain(start + blocks + "9 END PGM P MM\n", on(kTable)));
    };
    EXPECT_NEAR(time_s("2 L C+90 F360\n"), 15, 1e-9);
    // A quarter of a circle of 50 mm at 360 mm/min.
    EXPECT_NEAR(time_s("2 L M116\n3 L C+90 F360\n"), 60 * (kPi / 2 * 50) / 360, 1e-3);
    EXPECT_NEAR(time_s("2 L M116\n3 L M117\n4 L C+90 F360\n"), 15, 1e-9);
}

TEST(RotaryFeed, of_siemens_counts_what_fgroup_says_at_the_radii_of_fgref) {
    const std::string start = "G71 G90 G54\nG0 X0 Y5 Z0 A0 C0 M3 S1000\n";
    const auto time_s = [&](const std::string& blocks) {
        return feed_s(read_siemens(start + blocks + "M30\n", on(kTable)));
    };
    EXPECT_NEAR(time_s("G1 X20 C40 F300\n"), 4, 1e-9);
    EXPECT_NEAR(time_s("FGROUP(X,Y,Z,C)\nG1 X20 C40 F300\n"), 60 * std::sqrt(400 + 1600.0) / 300, 1e-6);
    // 10 mm from the axis 90 degrees are 15.708 mm.
    EXPECT_NEAR(time_s("FGROUP(X,Y,Z,C) FGREF[C]=10\nG1 C90 F300\n"), 60 * (kPi / 2 * 10) / 300, 1e-6);
    EXPECT_NEAR(time_s("FGROUP(X,Y,Z,C)\nFGROUP()\nG1 X20 C40 F300\n"), 4, 1e-9);
}

TEST(RotarySpeed, beyond_the_machine_is_said_with_its_line) {
    const motion::Machine umc = *motion::named_machine("haas-umc");  // C: 8 rpm, 2880 deg/min
    const std::string start = "G21 G90 M3 S1000\nG0 X0 Y5 Z0 B0 C0\n";
    const auto slow = read_gcode(start + "G1 C90 F2800\n", on(umc));
    ASSERT_TRUE(slow);
    EXPECT_FALSE(warns(*slow, "faster"));
    const auto fast = read_gcode(start + "G1 C90 F2800\nG1 C180 F6000\nG1 C0 F9000\n", on(umc));
    ASSERT_TRUE(fast);
    ASSERT_TRUE(warns(*fast, "faster than the 2880 deg/min that the machine haas-umc allows"));
    for (const Warning& warning : fast->warnings) {
        if (warning.text.find("2880") == std::string::npos) continue;
        EXPECT_EQ(warning.line, 4);
        EXPECT_NE(warning.text.find("at worst 9000 deg/min on line 5"), std::string::npos) << warning.text;
    }
}

TEST(RotarySpeed, of_a_tip_beyond_any_machine_is_said) {
    // Half a metre from the axis, 60 turns a minute: 188 m/min.
    const auto program = read_gcode("G21 G90 M3 S1000\nG0 X500 Y0 Z0 A0 C0\nG1 C360 F21600\n", on(kTable));
    ASSERT_TRUE(program);
    EXPECT_TRUE(warns(*program, "the tip runs over the part at up to 188 m/min"));
}

TEST(RotaryWords, that_may_be_radians_are_said) {
    std::string radians = "G21 G90 M3 S1000\nG0 X0 Y0 Z0 A0 C0\nF500\n", degrees = radians;
    for (int i = 1; i <= 30; ++i) {
        radians += "G1 X" + std::to_string(i) + " C" + std::to_string(0.2 * i) + "\n";
        degrees += "G1 X" + std::to_string(i) + " C" + std::to_string(12 * i) + "\n";
    }
    EXPECT_TRUE(warns(*read_gcode(radians, on(kTable)), "if these are radians"));
    EXPECT_FALSE(warns(*read_gcode(degrees, on(kTable)), "if these are radians"));
}

}  // namespace
}  // namespace tribo::readers
