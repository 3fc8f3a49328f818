// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>
#include <string>

#include "readers/gcode/gcode_text.hpp"
#include "readers/gcode/motion/arc.hpp"

namespace tribo::readers {
namespace {

using motion::Move;
using motion::Program;
using std::numbers::pi;

struct ArcCase {
    const char* name;
    const char* start;
    const char* block;
    double length_mm;  // closed form
    Vec3 normal;
    double turn_rad;
};

TEST(GcodeArc, HasTheLengthNormalAndTurnOfTheClosedForm) {
    const ArcCase cases[] = {
        {"quarter, centre", "X10 Y0 Z0", "G3 X0 Y10 I-10 J0", 5 * pi, {0, 0, 1}, pi / 2},
        {"three quarters, clockwise", "X10 Y0 Z0", "G2 X0 Y10 I-10", 15 * pi, {0, 0, -1}, 1.5 * pi},
        {"full circle", "X10 Y0 Z0", "G3 I-10", 20 * pi, {0, 0, 1}, 2 * pi},
        {"full circle, end repeated", "X10 Y0 Z0", "G2 X10 Y0 I-10 J0", 20 * pi, {0, 0, -1}, 2 * pi},
        {"quarter, radius", "X10 Y0 Z0", "G3 X0 Y10 R10", 5 * pi, {0, 0, 1}, pi / 2},
        {"three quarters, negative radius", "X10 Y0 Z0", "G3 X0 Y10 R-10", 15 * pi, {0, 0, 1}, 1.5 * pi},
        {"clockwise negative radius", "X10 Y0 Z0", "G2 X0 Y10 R-10", 15 * pi, {0, 0, -1}, 1.5 * pi},
        {"half, radius", "X10 Y0 Z0", "G3 X-10 R10", 10 * pi, {0, 0, 1}, pi},
        {"half, radius short by rounding", "X10.001 Y0 Z0", "G3 X-10.001 R10", 10.001 * pi, {0, 0, 1}, pi},
        {"helix", "X10 Y0 Z0", "G3 X0 Y10 Z3 I-10", std::hypot(5 * pi, 3), {0, 0, 1}, pi / 2},
        {"helix of a full turn", "X10 Y0 Z0", "G2 Z-2 I-10", std::hypot(20 * pi, 2), {0, 0, -1}, 2 * pi},
        {"helix of three turns", "X10 Y0 Z0", "G3 Z-6 I-10 P3", std::hypot(60 * pi, 6), {0, 0, 1}, 6 * pi},
        {"quarter and two turns", "X10 Y0 Z0", "G3 X0 Y10 I-10 P3", 45 * pi, {0, 0, 1}, 4.5 * pi},
        // In the ZX plane the first axis is Z: counter-clockwise seen against +Y runs from +Z to +X.
        {"G18", "X0 Y0 Z5", "G18 G3 X5 Z0 I0 K-5", 2.5 * pi, {0, 1, 0}, pi / 2},
        {"G18 clockwise", "X0 Y0 Z5", "G18 G2 X5 Z0 K-5", 7.5 * pi, {0, -1, 0}, 1.5 * pi},
        {"G18 radius", "X0 Y0 Z5", "G18 G3 X5 Z0 R5", 2.5 * pi, {0, 1, 0}, pi / 2},
        {"G18 helix", "X0 Y0 Z5", "G18 G3 X5 Y1 Z0 K-5", std::hypot(2.5 * pi, 1), {0, 1, 0}, pi / 2},
        {"G19", "X0 Y5 Z0", "G19 G3 Y0 Z5 J-5 K0", 2.5 * pi, {1, 0, 0}, pi / 2},
        {"G19 clockwise", "X0 Y5 Z0", "G19 G2 Y0 Z5 J-5", 7.5 * pi, {-1, 0, 0}, 1.5 * pi},
        {"absolute centre", "X10 Y0 Z0", "G90.1 G3 X0 Y10 I0 J0", 5 * pi, {0, 0, 1}, pi / 2},
        {"incremental end", "X10 Y0 Z0", "G91 G3 X-10 Y10 I-10", 5 * pi, {0, 0, 1}, pi / 2},
        // A chord of one radius subtends a sixth of a turn.
        {"sixth", "X10 Y0 Z0", "G3 X5 Y8.660254037844386 R10", 10 * pi / 3, {0, 0, 1}, pi / 3},
    };
    for (const ArcCase& c : cases) {
        const Program program = program_of(std::string("G21 M3 F100\nG0 ") + c.start + "\n" + c.block + "\n");
        ASSERT_EQ(program.moves.size(), 1U) << c.name;
        const Move& move = program.moves[0];
        ASSERT_TRUE(move.arc.has_value()) << c.name;
        EXPECT_NEAR(motion::path_length_mm(move), c.length_mm, 1e-9) << c.name;
        EXPECT_EQ(move.arc->normal, c.normal) << c.name;
        EXPECT_NEAR(move.arc->turn_rad, c.turn_rad, 1e-9) << c.name;
        const Vec3 last = motion::pose_at(move, 1 - 1e-12).tip_mm;
        EXPECT_NEAR(distance(last, move.end.tip_mm), 0, 1e-9) << c.name;
    }
}

TEST(GcodeArc, GoesOnWithTheModalCode) {
    const Program program = program_of("G21 M3 F100\nG0 X10 Y0 Z0\nG3 X0 Y10 I-10\nX-10 Y0 J-10\nI10\n");
    ASSERT_EQ(program.moves.size(), 3U);
    EXPECT_NEAR(feed_mm(program), 30 * pi, 1e-9);
}

TEST(GcodeArc, CountsAbsoluteCentresFromTheWorkOrigin) {
    const Program program =
        program_of("G21 M3 F100\nG10 L2 P1 X7 Y-3\nG0 X10 Y0 Z0\nG90.1 G3 X0 Y10 I0 J0\n");
    ASSERT_EQ(program.moves.size(), 1U);
    expect_near(program.moves[0].arc->centre_mm, {7, -3, 0});
}

RC_GTEST_PROP(GcodeArc, RadiusAndCentreGiveTheSameArc, ()) {
    const double radius = *rc::gen::inRange(1, 100'000) / 1000.0;
    const double from = *rc::gen::inRange(0, 36'000) * pi / 18'000;
    const double turn = *rc::gen::inRange(100, 35'900) * pi / 18'000;
    const bool clockwise = *rc::gen::arbitrary<bool>();
    const double to = clockwise ? from - turn : from + turn;
    gcode::ArcEnds ends;
    ends.clockwise = clockwise;
    ends.start_mm = {radius * std::cos(from), radius * std::sin(from), 1};
    ends.end_mm = {radius * std::cos(to), radius * std::sin(to), 2};
    const auto by_centre = gcode::arc_about_centre(ends, {0, 0, 0}, 1);
    const auto by_radius = gcode::arc_of_radius(ends, turn > pi ? -radius : radius);
    RC_ASSERT(by_centre.has_value());
    RC_ASSERT(by_radius.has_value());
    RC_ASSERT(std::abs(by_centre->turn_rad - turn) < 1e-9);
    // Near half a turn the apothem is a small difference of large numbers: the centre of an R arc is ill
    // conditioned there by nature.
    const double tolerance = std::abs(turn - pi) < 0.1 ? 1e-4 : 1e-7;
    RC_ASSERT(std::abs(by_radius->turn_rad - turn) < tolerance);
    RC_ASSERT(distance(by_radius->centre_mm, by_centre->centre_mm) < tolerance * radius);
    RC_ASSERT(by_radius->normal == by_centre->normal);
}

TEST(GcodeArc, ToleratesTheRoundingThatLinuxcncTolerates) {
    enum Reading { silent, said, refused };
    const auto reading_of = [](const std::string& text) {
        const auto read = read_gcode("M3 F100\n" + text);
        if (!read) return refused;
        return warns_of(*read, 3, "the radius of an arc differs at its start and end") ? said : silent;
    };
    const std::string mm = "G21 G0 X10 Y0 Z0\n", inches = "G20 G0 X1 Y0 Z0\n";
    EXPECT_EQ(reading_of(mm + "G3 X0 Y10.0049 I-10"), silent);
    EXPECT_EQ(reading_of(mm + "G3 X0 Y10.0099 I-10"), silent);  // under 0.1 % of the radius
    EXPECT_EQ(reading_of(mm + "G3 X0 Y10.011 I-10"), said);     // over it
    EXPECT_EQ(reading_of(mm + "G3 X0 Y10.02828 I-10"), said);   // 0.02 sqrt(2), LinuxCNC's tolerance
    EXPECT_EQ(reading_of(mm + "G3 X0 Y10.02829 I-10"), refused);
    EXPECT_EQ(reading_of(inches + "G3 X0 Y1.002828 I-1"), said);
    EXPECT_EQ(reading_of(inches + "G3 X0 Y1.002829 I-1"), refused);
    // Radius 1000: 0.1 % would be 1 mm, but never more than 0.5 mm.
    EXPECT_EQ(reading_of(mm + "G3 X-990 Y1000.4 I-1000"), silent);
    EXPECT_EQ(reading_of(mm + "G3 X-990 Y1000.6 I-1000"), refused);
}

}  // namespace
}  // namespace tribo::readers
