// SPDX-License-Identifier: MIT
// The paths of the cycles are those that rs274 of linuxcnc-uspace 2.9.0~pre1 gives for the same text.
#include <gtest/gtest.h>
#include <string>

#include "readers/gcode/gcode_text.hpp"
#include "readers/gcode/motion/cycles.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

using motion::MoveKind;

// Each move as r (rapid), f (feed) or d (dwell) with the end's coordinates or the seconds.
std::string path_of(const std::string& text, const GcodeOptions& options = {}) {
    const motion::Program program =
        program_of("G21 G90 G94 G17 M3 S1000 F100\nG0 X0 Y0 Z5\n" + text + "\n", options);
    std::string path;
    for (const motion::Move& move : program.moves) {
        const Vec3 end = move.end.tip_mm;
        if (!path.empty()) path += ' ';
        if (move.kind == MoveKind::dwell) {
            path += "d" + short_decimal(move.duration_s, 3);
        } else {
            path += (move.kind == MoveKind::rapid ? "r" : "f") + short_decimal(end.x, 3) + "," +
                    short_decimal(end.y, 3) + "," + short_decimal(end.z, 3);
        }
    }
    return path;
}

TEST(GcodeCycles, FollowThePathsOfLinuxcnc) {
    const struct {
        const char* text;
        const char* path;
    } cases[] = {
        {"G99 G81 X1 Y2 Z-3 R1\nX3", "r1,2,5 r1,2,1 f1,2,-3 r1,2,1 r3,2,1 f3,2,-3 r3,2,1"},
        {"G98 G81 X1 Z-3 R1\nX3", "r1,0,5 r1,0,1 f1,0,-3 r1,0,5 r3,0,5 r3,0,1 f3,0,-3 r3,0,5"},
        {"G99 G82 X1 Z-3 R1 P0.5", "r1,0,5 r1,0,1 f1,0,-3 d0.5 r1,0,1"},
        {"G98 G73 X1 Y2 Z-3 R1 Q1.5",
         "r1,2,5 r1,2,1 f1,2,-0.5 r1,2,-0.246 f1,2,-2 r1,2,-1.746 f1,2,-3 r1,2,5"},
        {"G99 G83 X1 Y2 Z-3 R1 Q1.5",
         "r1,2,5 r1,2,1 f1,2,-0.5 r1,2,1 r1,2,-0.246 f1,2,-2 r1,2,1 r1,2,-1.746 f1,2,-3 r1,2,1"},
        {"G98 G84 X1 Z-3 R1", "r1,0,5 r1,0,1 f1,0,-3 f1,0,5"},
        {"M4 G98 G74 X1 Z-3 R1", "r1,0,5 r1,0,1 f1,0,-3 f1,0,5"},
        {"G98 G85 X1 Z-3 R1", "r1,0,5 r1,0,1 f1,0,-3 f1,0,1 r1,0,5"},
        {"G99 G86 X1 Z-3 R1 P1", "r1,0,5 r1,0,1 f1,0,-3 d1 r1,0,1"},
        {"G98 G89 X1 Z-3 R1 P1", "r1,0,5 r1,0,1 f1,0,-3 d1 f1,0,5"},
        // R above the tip: first up, then across.
        {"G98 G81 X1 Z-3 R7", "r0,0,7 r1,0,7 f1,0,-3 r1,0,7"},
        // In G91 R counts from where the cycle began, Z from R, and L steps on.
        {"G99 G91 G81 X1 Y2 Z-2 R-3 L2\nX1",
         "r1,2,5 r1,2,2 f1,2,0 r1,2,2 r2,4,2 f2,4,0 r2,4,2 "
         "r3,4,2 f3,4,0 r3,4,2"},
        // Along the axis normal to the plane.
        {"G99 G18 G81 X1 Z3 Y-2 R2", "r0,2,5 r1,2,3 f1,-2,3 r1,2,3"},
        {"G99 G19 G81 X-2 Z3 Y2 R2", "r2,0,5 r2,2,3 f-2,2,3 r2,2,3"},
        // Words stay until they are written again; G80 and other motions end the cycle.
        {"G99 G81 X1 Z-1 R1\nX2 Z-2\nX3 R0.5\nG80\nG0 X4",
         "r1,0,5 r1,0,1 f1,0,-1 r1,0,1 r2,0,1 f2,0,-2 r2,0,1 "
         "r3,0,1 r3,0,0.5 f3,0,-2 r3,0,0.5 r4,0,0.5"},
        // G92 and work offsets move the levels as well.
        {"G92 Z0\nG99 G81 X1 Z-3 R-1", "r1,0,5 r1,0,4 f1,0,2 r1,0,4"},
    };
    for (const auto& c : cases) EXPECT_EQ(path_of(c.text), c.path) << c.text;
}

TEST(GcodeCycles, FollowFanucWhereTheDialectSaysSo) {
    GcodeOptions fanuc;
    fanuc.dialect = GcodeDialect::fanuc;
    EXPECT_EQ(path_of("G76 X1 Z-3 R1 Q0.2 P500", fanuc), "r1,0,5 r1,0,1 f1,0,-3 d0.5 r1,0,5");
    EXPECT_EQ(path_of("G98 G84 X1 Z-3 R1", fanuc), "r1,0,5 r1,0,1 f1,0,-3 f1,0,1 r1,0,5");
    EXPECT_EQ(path_of("G98 G81 Z-3 R1 K0\nX2", fanuc), "r2,0,5 r2,0,1 f2,0,-3 r2,0,5");
    EXPECT_EQ(path_of("G4 P1500\nG4 X2.", fanuc), "d1.5 d2");
    // Levels stay those of the block that wrote them: the positions alone are increments.
    EXPECT_EQ(path_of("G99 G81 X1 Z-3 R1\nG91 X2 K2\nG90 X9", fanuc),
              "r1,0,5 r1,0,1 f1,0,-3 r1,0,1 r3,0,1 f3,0,-3 r3,0,1 r5,0,1 f5,0,-3 r5,0,1 r9,0,1 f9,0,-3 "
              "r9,0,1");
    EXPECT_EQ(path_of("G91 G99 G81 X1 Z-4 R-4\nG90 X3\nG91 X2 Z-5", fanuc),
              "r1,0,5 r1,0,1 f1,0,-3 r1,0,1 r3,0,1 f3,0,-3 r3,0,1 r5,0,1 f5,0,-4 r5,0,1");
    EXPECT_EQ(path_of("G5.1 Q1\nG0 X1\nG5 P10000", fanuc), "r1,0,5");
}

TEST(GcodeCycles, BeginWhereTheToolStandsWithoutR) {
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    EXPECT_EQ(path_of("G98 G81 X1 Z-3\nX3", options), "r1,0,5 f1,0,-3 r1,0,5 r3,0,5 f3,0,-3 r3,0,5");
    const motion::Program program = program_of("G21 G90 M3 S1000 F100\nG0 X0 Y0 Z5\nG81 X1 Z-3\n", options);
    EXPECT_TRUE(warns_of(program, 3, "G81 without R: the feed begins where the tool stands"));
}

TEST(GcodeCycles, SayWhatTheyAssume) {
    const auto warns = [](const char* text, const char* what) {
        return warns_of(program_of(std::string("G21 M3 F9\nG0 X0 Y0 Z5\n") + text), 3, what);
    };
    EXPECT_TRUE(warns("G81 X1 Z-3 R1\n", "neither G98 nor G99"));
    EXPECT_FALSE(warns("G98 G81 X1 Z-3 R1\n", "neither G98 nor G99"));
    EXPECT_TRUE(warns("G98 G88 X1 Z-3 R1\n", "by hand"));
}

// Haas VF series operator's manual, G83: the first peck is I deep, each later one J less, at least K.
TEST(GcodeCycles, ShortensThePecksOfHaasControls) {
    GcodeOptions fanuc;
    fanuc.dialect = GcodeDialect::fanuc;
    EXPECT_EQ(path_of("G99 G73 X0 Z-10 R1 I4 J1 K2", fanuc),
              "r0,0,1 f0,0,-3 r0,0,-2.746 f0,0,-6 r0,0,-5.746 f0,0,-8 r0,0,-7.746 f0,0,-10 r0,0,1");
    EXPECT_EQ(path_of("G99 G83 X0 Z-5 R1 I4 J1 K2", fanuc),
              "r0,0,1 f0,0,-3 r0,0,1 r0,0,-2.746 f0,0,-5 r0,0,1");
    // I alone: equal pecks.
    EXPECT_EQ(path_of("G99 G73 X0 Z-7 R1 I4", fanuc), path_of("G99 G73 X0 Z-7 R1 Q4", fanuc));
    EXPECT_EQ(path_of("G99 G84 X0 Z-7 R1 J2", fanuc), path_of("G99 G84 X0 Z-7 R1", fanuc));
    EXPECT_EQ(path_of("G99 G76 X0 Z-7 R1 I0.1 J0", fanuc), path_of("G99 G76 X0 Z-7 R1 Q0.1", fanuc));
}

}  // namespace
}  // namespace tribo::readers
