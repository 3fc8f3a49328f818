// SPDX-License-Identifier: MIT
// Real programs against LinuxCNC's own interpreter. The numbers were made with rs274_path.py (which see) and
// linuxcnc-uspace 2.9.0~pre1; where the interpreter refuses a file for words that do not change X, Y and Z,
// those words were deleted for it: G43 H1 in cds, M6 T3 in wave, M428, M429, T1 M6 and the words A and C in
// boat. It refuses G6.2 (farfalla): that length and box are of De Boor's algorithm at 200,000 parameters.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "motion/program_summary.hpp"
#include "readers/gcode/gcode_text.hpp"
#include "readers/real_files.hpp"

namespace tribo::readers {
namespace {

struct RealProgram {
    const char* name;
    std::size_t feed_moves;  // 0: not compared, as splines are cut differently
    double feed_mm;
    Box3 bounds_mm;
    bool rotary;
    double tolerance_mm;
};

TEST(GcodeReader, ReadsRealProgramsAsLinuxcncDoes) {
    const RealProgram programs[] = {
        {"camotics-3x-wave.gcode", 1151, 4691.4037148, {{0, 0, -2.496577}, {92, 92, 3}}, false, 1e-5},
        {"bantam-3x-pocket.nc", 45, 1129.2308964, {{13.1, 13.1, -2}, {63.1, 63.1, 5}}, false, 1e-5},
        {"lcnc-3x-cds.ngc", 241, 4616.6906863, {{0, -6.35, 27.020266}, {101.6, 101.6, 53.34}}, false, 1e-5},
        {"lcnc-3x-arcspiral.ngc",
         1000,
         2569.3664782,
         {{-49.476410, -50.274371, -2.54}, {47.880596, 48.678496, 25.4}},
         false,
         1e-5},
        {"lcnc-3x-flowsnake-ocode.ngc",
         3073,
         44.6570776,
         {{0.25, -0.010363, 0}, {3.75, 3.95, 1}},
         false,
         1e-5},
        {"lcnc-5x-boat-xyzac.ngc",
         1739,
         3552.5660774,
         {{-49.969, -26.323, -13.25}, {46.264, 22.345, 5}},
         true,
         1e-5},
        {"lcnc-3x-nurbs-g6-farfalla.ngc",
         0,
         362.0546943,
         {{6.515294, 7.045765, -1}, {102.489906, 64.903486, 1}},
         false,
         1e-3},
    };
    for (const RealProgram& expected : programs) {
        const auto bytes = real_file(expected.name);
        if (!bytes) GTEST_SKIP() << "no ../shared/data/gcode";
        const motion::Program program = program_of(*bytes);
        const motion::ProgramSummary summary = motion::testing::summary_of(program);
        if (expected.feed_moves != 0) {
            EXPECT_EQ(summary.feed_moves, expected.feed_moves) << expected.name;
        }
        EXPECT_NEAR(summary.path_mm, expected.feed_mm, expected.tolerance_mm) << expected.name;
        expect_near(summary.bounds_mm.min, expected.bounds_mm.min, expected.tolerance_mm);
        expect_near(summary.bounds_mm.max, expected.bounds_mm.max, expected.tolerance_mm);
        EXPECT_EQ(program.has_rotary_words, expected.rotary) << expected.name;
    }
}

// The same path through the reader with a program of our own: a contour with an arc, a loop, a helix and a
// drilling cycle; lengths in closed form.
TEST(GcodeReader, ReadsAWholeProgramToItsLengthAndBounds) {
    const motion::Program program = program_of(
        "%\n(a plate)\nN10 G21 G90 G17 G54\nN20 T1 M6\nN30 S3000 M3\nG0 X0 Y0 Z5\nG1 Z-1 F300\nX40\n"
        "G3 X50 Y10 I0 J10\nG1 Y30\no101 repeat [3]\nG91 G1 X-10\nG90\no101 endrepeat\n"
        "G3 X20 Y30 Z-3 I0 J-5\nG0 Z5\nG81 X10 Y10 Z-4 R2 F200\nX20\nG80\nM5\nM2\n%\n");
    const motion::ProgramSummary summary = motion::testing::summary_of(program);
    using std::numbers::pi;
    EXPECT_EQ(summary.feed_moves, 10u);
    EXPECT_NEAR(summary.path_mm, 6 + 40 + 5 * pi + 20 + 30 + std::hypot(10 * pi, 2) + 2 * 6, 1e-9);
    expect_near(summary.bounds_mm.min, {0, 0, -4}, 1e-9);
    expect_near(summary.bounds_mm.max, {50, 30, 5}, 1e-9);
    EXPECT_EQ(summary.tools, std::vector<int>{1});
    EXPECT_FALSE(program.has_rotary_words);
}

}  // namespace
}  // namespace tribo::readers
