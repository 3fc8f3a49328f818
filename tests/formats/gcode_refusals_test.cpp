// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <string>

#include "formats/gcode_reader.hpp"

namespace tribo::formats {
namespace {

struct Refusal {
    std::string text;
    int line, column;
    const char* cause;
};

TEST(GcodeReader, RefusesWhatItDoesNotKnowWithItsPlace) {
    const std::string ready = "G21 M3 F100\nG0 X10 Y0 Z0\n";  // two lines
    const Refusal refusals[] = {
        {"", 0, 0, "no G-code"},
        {"\n\n(only a comment)\n%\n", 0, 0, "no G-code"},
        {std::string("G0 X1\0 Y2", 9), 1, 6, "byte 0x00"},
        {"G0 X1 Y\xE4 Z2", 1, 7, "no number after Y"},
        {"\xFF\xFEG\0", 1, 1, "byte 0xFF"},
        {"G21\nG0 X1 (open\n", 2, 7, "not closed"},
        {"G21\nG0 X1 (a (b))\n", 2, 10, "inside another comment"},
        {"G21\nG0 X1 )\n", 2, 7, "')' cannot start a word"},
        {"G21\n12 X1\n", 2, 1, "'1' cannot start a word"},
        {"G21\nG0 X\n", 2, 4, "no number after X"},
        {"G21\nG0 X- Y1\n", 2, 4, "no number after X"},
        {"G21\nG0 X1.2.3\n", 2, 4, "malformed"},
        {"G21\nG0 X.\n", 2, 4, "malformed"},
        {"G21\nG0 X--1\n", 2, 4, "no number after X"},
        {"G21\nG0 X1E5\n", 2, 6, "E without a code"},
        {"G21\nG0 X" + std::string(65, '1') + "\n", 2, 4, "more than 64 digits"},
        {"G21\nG0 X1 X2\n", 2, 7, "X stands twice"},
        {"G21\nG0 X1 N5\n", 2, 7, "line number"},
        {"G21\nG0 X1 / Y1\n", 2, 7, "deletes whole blocks"},
        {"#1=5\n", 1, 1, "variables"},
        {"G21\nG0 X#1\n", 2, 5, "variables"},
        {"G21\nG1 X[1+2]\n", 2, 5, "variables"},
        {"O100 sub\n", 1, 1, "O-words"},
        {"O<name> call\n", 1, 1, "O-words"},
        {"O1 (a)\nO2 (b)\n", 2, 1, "second program"},
        {"TRAORI\n", 1, 1, "'TRAORI' is not a letter with a number"},
        {"G1 X=5\n", 1, 4, "'X=' is a word of another dialect"},
        {"G21 G20\n", 1, 5, "G20 contradicts G21"},
        {"G0 G1 X1\n", 1, 4, "G1 contradicts G0"},
        {"M3 M5\n", 1, 4, "M5 contradicts M3"},
        {"G999\n", 1, 1, "G999 is not known"},
        {"G1.55\n", 1, 1, "G code is not known"},
        {"G-1\n", 1, 1, "G code is not known"},
        {"M200\n", 1, 1, "M200 is not known"},
        {"G5.2 X1\n", 1, 1, "G5.2 (splines) is not read yet"},
        {"G41 D1\n", 1, 1, "G41 (cutter radius compensation) is not read yet"},
        {"G83 Z-5 R2 Q1\n", 1, 1, "G83 (canned cycles) is not read yet"},
        {"G43.4 H1\n", 1, 1, "G43.4 (tool tip control) is not read yet"},
        {"G68.2 X0\n", 1, 1, "planes) is not read yet"},
        {"G38.2 Z-5\n", 1, 1, "G38.2 (probing) is not read yet"},
        {"M98 P1000\n", 1, 1, "M98 (subprograms) is not read yet"},
        {"G21\nX1 Y2\n", 2, 1, "without a motion code"},
        {"G21 G0 X0 Y0 Z0\nG80\nX1\n", 3, 1, "without a motion code"},
        {"G21 M3\nG0 X0 Y0 Z0\nG1 X1\n", 3, 4, "before any F"},
        {"G21 M3\nG0 X0 Y0 Z0\nG1 X1 F0\n", 3, 7, "feed rate 0"},
        {"G21\nG1 X1 F-5\n", 2, 7, "negative"},
        {"G21\nS-5\n", 2, 1, "negative"},
        {"G21\nT1.5 M6\n", 2, 1, "not a whole number"},
        {ready + "G93 G1 X1\n", 3, 8, "G93 without its own F"},
        {ready + "G93 G1 X1 F2\nX2\n", 4, 1, "G93 without its own F"},
        {ready + "G93\nG94\nG1 X1\n", 5, 4, "before any F"},
        {ready + "G95 G1 X1 F0.1\n", 3, 11, "spindle speed unknown"},
        {ready + "G3 X0 Y10\n", 3, 4, "without centre or radius"},
        {ready + "G3 X0 Y11 I-10\n", 3, 11, "10 mm at its start and 11 mm at its end"},
        {ready + "G3 X0 Y10 R5\n", 3, 11, "radius 5 mm cannot reach the end, which lies 14.1421 mm"},
        {ready + "G3 X10 Y0 R5\n", 3, 11, "ends where it starts"},
        {ready + "G3 X0 Y10 R10 I-10\n", 3, 11, "a radius and a centre"},
        {ready + "G3 X0 Y10 I-10 K1\n", 3, 16, "no use for K"},
        {ready + "G3 X0 I0 J0\n", 3, 7, "centre at its start"},
        {ready + "G90.1 G3 X0 Y10 I0\n", 3, 17, "needs both I and J"},
        {ready + "G3 I-10 P0\n", 3, 9, "number of turns"},
        {ready + "G1 X5 I2\n", 3, 7, "I without an arc"},
        {ready + "G1 X5 P2\n", 3, 7, "P without a code"},
        {ready + "G1 X5 U2\n", 3, 7, "axes U, V and W"},
        {ready + "G1 X2000000\n", 3, 4, "more than a kilometre"},
        {ready + "G3 I9999999999\n", 3, 4, "more than a kilometre"},
        {ready + "G4\n", 3, 1, "without P"},
        {ready + "G4 P-1\n", 3, 4, "negative"},
        {ready + "G4 P1 X5\n", 3, 7, "X without a code"},
        {ready + "G10 L20 P1 X0\n", 3, 5, "G10 L2"},
        {ready + "G10 L2 P10 X0\n", 3, 8, "work system P"},
        {ready + "G10 L2 P1 R5\n", 3, 11, "turned work systems"},
        {ready + "G92\n", 3, 1, "without coordinates"},
        {ready + "G1 G92 X5\n", 3, 4, "both claim"},
        {ready + "G53 G1 X5\n", 3, 1, "G53"},
        {ready + "G91 G53 G0 X5\n", 3, 5, "G91"},
        {ready + "G28\nG1 X5\n", 4, 4, "unknown X, which line 3"},
        {ready + "G28 Z20\nG92 Z0\n", 4, 1, "since line 3"},
    };
    for (const Refusal& refusal : refusals) {
        GcodeOptions options;
        options.source_name = "part.nc";
        const auto program = read_gcode(refusal.text, options);
        ASSERT_FALSE(program.has_value()) << refusal.text;
        const Error& error = program.error();
        EXPECT_EQ(error.file, "part.nc") << refusal.text;
        EXPECT_EQ(error.line, refusal.line) << refusal.text << error.text();
        EXPECT_EQ(error.column, refusal.column) << refusal.text << error.text();
        EXPECT_NE(error.cause.find(refusal.cause), std::string::npos) << refusal.text << error.text();
        EXPECT_FALSE(error.remedy.empty()) << error.text();
    }
}

TEST(GcodeReader, RefusesMoreMovesThanAllowed) {
    GcodeOptions options;
    options.max_moves = 2;
    const auto program = read_gcode("G21 M3 F100\nG0 X0 Y0 Z0\nG1 X1\nX2\nX3\n", options);
    ASSERT_FALSE(program.has_value());
    EXPECT_EQ(program.error().line, 5);
}

}  // namespace
}  // namespace tribo::formats
