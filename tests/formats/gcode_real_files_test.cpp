// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "gcode_text.hpp"
#include "real_files.hpp"

namespace tribo::formats {
namespace {

// Counts and lengths were computed by an independent script from the words of the files.
struct RealProgram {
    const char* name;
    std::size_t moves;
    double feed_mm, rapid_mm;
    bool rotary;
};

TEST(GcodeReader, ReadsRealProgramsToTheLengthsOfAnIndependentScript) {
    const RealProgram programs[] = {
        {"camotics-3x-wave.gcode", 1152, 4691.403715, 4.802791, false},
        {"bantam-3x-pocket.nc", 50, 1129.230896, 63.957094, false},
        {"lcnc-3x-cds.ngc", 263, 4616.690686, 830.890183, false},
        {"lcnc-3x-arcspiral.ngc", 1002, 2569.366478, 78.740002, false},
        {"lcnc-5x-boat-xyzac.ngc", 1810, 3552.566077, 1047.186977, true},
    };
    for (const RealProgram& expected : programs) {
        const auto bytes = real_file(expected.name);
        if (!bytes) GTEST_SKIP() << "no ../shared/data/gcode";
        const motion::Program program = program_of(*bytes);
        EXPECT_EQ(program.moves.size(), expected.moves) << expected.name;
        EXPECT_NEAR(feed_mm(program), expected.feed_mm, 1e-4) << expected.name;
        EXPECT_NEAR(rapid_mm(program), expected.rapid_mm, 1e-4) << expected.name;
        EXPECT_EQ(program.has_rotary_words, expected.rotary) << expected.name;
    }
}

TEST(GcodeReader, RefusesRealProgramsThatNeedMoreThanItKnows) {
    const auto splines = real_file("lcnc-3x-nurbs-g6-farfalla.ngc");
    if (!splines) GTEST_SKIP() << "no ../shared/data/gcode";
    const auto second = read_gcode(*splines);
    ASSERT_FALSE(second.has_value());
    EXPECT_EQ(second.error().line, 13);
}

}  // namespace
}  // namespace tribo::formats
