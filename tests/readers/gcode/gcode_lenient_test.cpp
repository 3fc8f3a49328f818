// SPDX-License-Identifier: MIT
// What the reader passes over with a warning, and what it takes in place of a word that a control reads
// otherwise. Lengths follow from the words.
#include <cmath>
#include <gtest/gtest.h>
#include <span>
#include <string>

#include "readers/gcode/gcode_text.hpp"

namespace tribo::readers {
namespace {

// A program, a warning of it, and the length of its feed moves.
struct Passed {
    std::string text;
    int line;  // 0: no warning is looked for
    const char* warning;
    double feed_mm;
};

void expect_passed(std::span<const Passed> cases, GcodeDialect dialect) {
    for (const Passed& passed : cases) {
        GcodeOptions options;
        options.dialect = dialect;
        const motion::Program program = program_of(passed.text, options);
        std::string said;
        for (const Warning& warning : program.warnings) said += warning.message() + "\n";
        if (passed.line != 0) {
            EXPECT_TRUE(warns_of(program, passed.line, passed.warning)) << passed.text << said;
        }
        EXPECT_NEAR(feed_mm(program), passed.feed_mm, 1e-9) << passed.text << said;
    }
}

TEST(GcodeReader, TakesTheWordsOfOneControlAsTheyAreMeantThere) {
    const std::string ready = "G21 M3 F100\nG0 X0 Y0 Z5\n";  // two lines
    const Passed fanuc[] = {
        {ready + "G10 L50\nN1815 P1 R5\nN3410 R0.05\nG11\nG1 X10\n", 3, "values of the control", 10},
        {ready + "G101 X0\nG1 X10\nG100 X0\nX10\n", 0, "", 10 + 20},
        {ready + "G101 Y0\nG1 X10\nG100\nX20\n", 0, "", 20},
        // two modes in a block: the last one holds
        {ready + "G90 G91 G1 X10\nX10\n", 3, "G90 and G91 stand in one block: the last one holds", 20},
        {ready + "G0 G1 X10\nG17 G41 G40 X20\n", 4, "G41 and G40", 20},
        {ready + "IF [#5405 GE 6000] THEN #3000=1\nG1 X10\n", 3, "#5405 is a timer", 10},
    };
    expect_passed(fanuc, GcodeDialect::fanuc);
    const Passed linuxcnc[] = {
        {"G21 M3 F100\nG10 L20 P0 X0 Y0 Z5\nG1 X10\n", 2, "count from the stock's origin", 10},
        {ready + "G38.2 Z-9\nG10 L20 P1 Z1\nG1 Z2\n", 4, "taken to stay where it was", 1},
    };
    expect_passed(linuxcnc, GcodeDialect::linuxcnc);
}

TEST(GcodeReader, PassesOverWhatLeavesThePathAsItIs) {
    const std::string ready = "G21 M3 F100\nG0 X0 Y0 Z5\n";  // two lines
    const Passed cases[] = {
        // words
        {ready + "M45\nG1 X10\n", 3, "M45 is not known", 10},
        {ready + "M45 P7 S2 Q1 R3\nG1 X10\n", 3, "M45 is not known", 10},
        {ready + "G1 X10 M321\n", 3, "M321 is not known", 10},
        {ready + "M13\nG1 X10\n", 0, "", 10},
        {ready + "M3 P100\nG1 X10\n", 3, "a share of the full speed", 10},
        {ready + "G1 X10 P2\n", 3, "P is used by no code", 10},
        {ready + "G1 X10 H2\n", 3, "H is used by no code", 10},
        {ready + "G1 X10 E2\n", 3, "E is used by no code", 10},
        {ready + "G1 X10 Q2\n", 3, "Q is used by no code", 10},
        {ready + "G1 X10 L2\n", 3, "L is used by no code", 10},
        {ready + "G1 X10 E2\n", 3, "a printer", 10},
        {ready + "G1 X10 I0 J0 K0 R0 U0 V0 W0\n", 3, "I is used by no code", 10},
        {ready + "T1.1 M6\nG1 X10\n", 3, "tool 1", 10},
        {ready + "G92 E0\nG1 X10\n", 3, "E is used by no code", 10},
        // codes
        {ready + "G0 G80 G40\nG1 X10\n", 0, "", 10},
        {ready + "G50 G69 G15\nG1 X10\n", 0, "", 10},
        {ready + "G50 S2000\nG1 X10\n", 3, "the largest speed of a lathe", 10},
        {ready + "G9 G1 X10\n", 0, "", 10},
        {ready + "G5 P10000\nG1 X10\nG5.1 Q1\nX20\n", 0, "", 20},
        {ready + "G8 P1\nG1 X10\n", 0, "", 10},
        {ready + "G8\nG1 X10\n", 0, "", 10},  // X is a radius (LinuxCNC), and stays so on a mill
        {ready + "G187 P3 E0.01\nG1 X10\n", 0, "", 10},
        {ready + "G28.1 X50\nG1 X10\n", 3, "moves nothing", 10},
        {ready + "G61 G1 X10\nG62 X20\nG64 P0.1\n", 0, "", 20},
        {ready + "G54.1 P12\nG1 X10\n", 3, "does not say where this work system lies", 10},
        {ready + "G154 P3 G1 X10\nG110 X20\nG54 P2 X30\n", 3, "does not say where", 30},
        {ready + "G44 H1\nG1 X10\n", 3, "coordinates name its tip", 10},
        {ready + "G10 L10 P1 R5\nG10 L12 P1 R3\nG1 X10\n", 3, "an offset of a tool", 10},
        {ready + "G4 S2\nG1 X10\n", 0, "", 10},
        {ready + "G4\nG1 X10\n", 3, "without a time", 10},
        {ready + "G53\nG1 X10\n", 3, "moves nothing", 10},
        // writing
        {ready + "(a (b) c)\nG1 X10\n", 3, "inside another one", 10},
        {ready + "(a (b)\nG1 X10\n", 3, "inside another one", 10},
        {ready + "G1 X10 (open\n", 3, "not closed", 10},
        {ready + "N5 /G1 X10\n", 3, "blocks that start with '/' are skipped", 0},
        {ready + "G1 X10 / Y20\n", 3, "what follows '/' in a block is skipped", 10},
        {ready + ": G1 X10\n:20 X20\nN30 X30\n", 0, "", 30},
        {":0100 (PART)\n" + ready + "G1 X10\n", 0, "", 10},
        {ready + "M117 Hello, X99 (world\nG1 X10 M30%\n", 3, "M117 is not known", 10},
        {ready + "G1 X10\n% TURN IT OVER\nX20\n", 4, "as a remark", 20},
        {ready + "G1 X10\n%\nX20\n", 4, "is not read", 10},
        {"$X\n" + ready + "G1 X10\n", 1, "begins with '$'", 10},
        {"O0100 (PART)\n" + ready + "G1 X10\n\x1A", 0, "", 10},
    };
    expect_passed(cases, GcodeDialect::linuxcnc);
    expect_passed(cases, GcodeDialect::fanuc);
}

TEST(GcodeReader, SaysWhatItTakesWhereControlsDiffer) {
    const std::string ready = "G21 M3 F100\nG0 X10 Y0 Z5\n";  // two lines
    const Passed cases[] = {
        // units
        {"G71 M3 F100\nG0 X10 Y0 Z5\nG1 X20\n", 0, "", 10},
        {"G70 M3 F100\nG0 X1 Y0 Z5\nG1 X2\n", 0, "", 25.4},
        // modal motion
        {ready + "G81 Z-1 R1\nG80\nX20\n", 5, "the last of G0 to G3 goes on", 2},
        {ready + "G1 X12\nG81 Z-1 R1\nG80\nX20 Z1\n", 6, "the last of G0 to G3 goes on", 2 + 2 + 8},
        {"G21 M3 F100\nX10 Y0 Z5\nG1 X20\n", 2, "before any motion code", 10},
        // places that only the machine knows
        {ready + "G28\nG1 X5\nY1 Z1\nX15\n", 4, "since line 3: it is left out", 10},
        {ready + "G91 G28 Z0\nG90 G1 X20 Z0\nX30\n", 4, "it is left out", 10},
        {ready + "G53 G1 Z0\nG1 Z0\nX20\n", 3, "the path is left out", 10},
        {ready + "G28 Z20\nG92 Z0\nG1 X20\n", 4, "the zero of the program is taken to stay", 10},
        {ready + "G28 A0\nG1 X20\n", 0, "", 10},
        {"G21 M3 F100 (no depth: Z)\nG28\nG1 X10 Y0\nX20\n", 4, "the tool is taken to start at Z0", 10},
        {ready + "$H\nG1 X20\n", 4, "it is left out", 0},
        {ready + "G81 X20 Z1 R1\nX30\n", 3, "its holes have no depth", 0},
        {ready + "G28 Z20\nG81 X20 Z-3 R2\nX30\n", 4, "it is left out", 5 + 5},
        {ready + "G38.2 Z-5\nG92 Z0\nG1 X20\n", 3, "(probing) ends where only the machine knows", 10},
        {ready + "G31 Z-5\nG0 Z1\nG1 X20\n", 3, "(probing)", 10},
        // offsets beside a motion
        {ready + "G0 G52 X5 Y0\nG1 X15\n", 0, "", 10},
        {ready + "G1 G92 X0\nG1 X10\n", 0, "", 10},
        // compensation
        {ready + "G41 D1\nG1 X20\nY20\nG40 X30\n", 3, "the programmed path is milled", 40},
        {ready + "G41.2 D1\nG1 X20 I0 J0 K1\nX30\nG40\n", 0, "", 20},
        {ready + "G41.1 D2\nG1 X20\nG41.1 D2 X30\nG40 X40\n", 0, "",
         std::hypot(10.0, 1.0) + 10 + std::hypot(10.0, 1.0)},
        // cycles
        {ready + "G83 Z-3 R2 Q0\n", 3, "the hole is drilled in one", 5},
        {ready + "G83 Z-3 R2\n", 3, "the hole is drilled in one", 5},
        {ready + "G81 Z-3 R2 Q1\n", 3, "Q is used by no code", 5},
        {ready + "G81 Z-3 R2 L0\nX20\n", 0, "", 5},
        {ready + "G74 Z-3 R2\n", 3, "does not turn left", 5 + 5},
        {ready + "M4 G84 Z-3 R2\n", 3, "does not turn right", 5 + 5},
        {ready + "G76 Z-3 R2 Q1\n", 3, "the shift Q off the wall", 5},
        {ready + "G87 Z-3 R2\n", 3, "drawing the tool out by hand", 5},
    };
    expect_passed(cases, GcodeDialect::linuxcnc);

    const Passed lathe[] = {{"G18 G21 M3 F100\nG0 X10 Z0\nG1 X20\nZ-5\n", 0, "", 15}};
    expect_passed(lathe, GcodeDialect::fanuc);
    EXPECT_TRUE(warns_of(program_of(lathe[0].text), 0, "if it is for a lathe"));
    EXPECT_FALSE(warns_of(program_of(ready + "G18 G1 X20\n"), 0, "if it is for a lathe"));

    // On a Fanuc control D holds until the next.
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    options.tools = {{1, 2}, {7, 4}};
    const motion::Program compensated =
        program_of("G21 M3 F100 T1 M6\nG0 X0 Y0 Z5\nG43 H1 D7\nG41 G1 X10\nX20\nG40\n", options);
    EXPECT_NEAR(compensated.moves.back().end.tip_mm.y, 2, 1e-12);
}

TEST(GcodeReader, SaysNoMoreThanIsWorthReading) {
    std::string text = "G21 M3 F100\nG0 X0 Y0 Z5\n";
    for (int i = 1000; i < 3000; ++i) text += "M" + std::to_string(i) + "\n";
    const motion::Program program = program_of(text + "G1 X10\n");
    ASSERT_EQ(program.warnings.size(), 1001U);
    EXPECT_NE(program.warnings.back().text.find("the others are not shown"), std::string::npos);
}

TEST(GcodeReader, ReadsArcsAsTheirNumbersSay) {
    const std::string ready = "G21 M3 F100\nG0 X10 Y0 Z5\n";  // two lines
    const Passed cases[] = {
        {ready + "G3 X0 Y10 I-10 J0 K0\n", 0, "", 5 * kPi},
        // K is the rise of a turn where the end says so too.
        {ready + "G3 X0 Y10 Z7 I-10 J0 K8\n", 3, "the rise of a turn", std::hypot(5 * kPi, 2.0)},
        // Only absolute centres fit, from here on.
        {ready + "G3 X0 Y10 I0 J0\nG1 Y20\nG3 X0 Y40 I0 J30\n", 3, "only in absolute coordinates",
         5 * kPi + 10 + 10 * kPi},
        // The centre fits both ways: incremental.
        {"G21 M3 F100\nG0 X0 Y0 Z5\nG3 X20 Y0 I10 J0\n", 0, "", 10 * kPi},
        // Within quadrants, without signs.
        {ready + "G0 G74 X10 Y0\nG3 X0 Y10 I10 J0\nX-10 Y0 I0 J10\n", 4, "within a quadrant", 10 * kPi},
        {ready + "G3 X0 Y10 R10 I-10 J0\n", 0, "", 5 * kPi},
        // A point moves nothing.
        {ready + "G90.1 G3 X10 Y0 I10 J0\nG1 X20\n", 3, "no larger than a point", 10},
    };
    expect_passed(cases, GcodeDialect::linuxcnc);

    // Without signs and with rounded numbers I-0.004 fits within 0.006 mm, I0.004 within 0.014 mm.
    const auto quadrant = program_of("G21 M3 F100\nG0 G74 X0 Y0 Z0\nG3 X0.49 Y0.5 I0.004 J0.5\n");
    ASSERT_EQ(quadrant.moves.size(), 1U);
    expect_near(quadrant.moves[0].arc->centre_mm, {-0.004, 0.5, 0});

    // An arc that fits one way tells of the others.
    GcodeOptions options;
    EXPECT_FALSE(read_gcode(ready + "G3 X0 Y10 I-10 J0\nG3 X-20 Y0 I0 J0\n", options).has_value());
    EXPECT_FALSE(read_gcode(ready + "G91.1 G3 X0 Y10 I0 J0\n", options).has_value());
    const auto mixed = read_gcode(ready + "G3 I5 J0\nG3 X0 Y10 I0 J0\n", options);
    ASSERT_FALSE(mixed.has_value());
    EXPECT_NE(mixed.error().cause.find("that of line 3 in both ways"), std::string::npos);
    // On a Fanuc control R counts and not the centre.
    options.dialect = GcodeDialect::fanuc;
    EXPECT_NEAR(feed_mm(program_of(ready + "G3 X0 Y10 R10 I-5 J0\n", options)), 5 * kPi, 1e-9);
}

// Polar coordinates, rotation, scaling and mirror images (Fanuc): places from plane geometry.
TEST(GcodeReader, PlacesTurnedScaledMirroredAndPolarCoordinates) {
    const std::string ready = "G21 M3 F100\nG0 X0 Y0 Z5\n";
    const auto end_of = [&](const std::string& text) {
        const motion::Program program = program_of(ready + text);
        return program.moves.empty() ? Vec3{} : program.moves.back().end.tip_mm;
    };
    const double half = std::sqrt(0.5);
    expect_near(end_of("G16\nG1 X10 Y45\n"), {10 * half, 10 * half, 5});
    expect_near(end_of("G16\nG1 X10 Y45\nY90\n"), {0, 10, 5});
    expect_near(end_of("G16\nG1 X10 Y45\nG91 Y45\n"), {0, 10, 5});
    expect_near(end_of("G52 X50 Y20\nG16\nG1 X10 Y90\n"), {50, 30, 5});
    expect_near(end_of("G16\nG1 X10 Y90\nG15\nX1\n"), {1, 10, 5});
    // Six holes on a circle, the angle in increments: the last one at 330 degrees.
    expect_near(end_of("G99 G16\nG81 X10 Y30 Z-1 R5\nG91 Y60 Z-6 R0 L5\n"),
                {10 * std::cos(kPi * 11 / 6), 10 * std::sin(kPi * 11 / 6), 5});

    expect_near(end_of("G68 X0 Y0 R90\nG1 X10\n"), {0, 10, 5});
    expect_near(end_of("G68 X5 Y0 R90\nG1 X10 Y0\n"), {5, 5, 5});
    expect_near(end_of("G1 X3 Y4\nG68 R90\nX4 Y4\n"), {3, 5, 5});  // about where the tool is
    expect_near(end_of("G68 X0 Y0 R90\nG1 X10 Y0\nG69\nX7\n"), {7, 10, 5});
    expect_near(end_of("G68 X0 Y0 R90\nG1 X10 Y0\nG91 X5\n"), {0, 15, 5});
    // A mirror image of turned coordinates is the image of what they give.
    expect_near(end_of("G51.1 X0\nG68 X0 Y0 R30\nG1 X20 Y0\n"), {-10 * std::sqrt(3.0), 10, 5});
    expect_near(end_of("G51.1 X0\nG68 X10 Y0 R30\nG1 X20 Y0\n"), {-10 - 5 * std::sqrt(3.0), 5, 5});
    expect_near(end_of("G51.1 X3 Y4\nG68 X10 Y0 R90\nG1 X20 Y0\n"), {-4, -2, 5});
    // The centre of a rotation is scaled, its angle is not.
    expect_near(end_of("G51 X0 Y0 Z0 P2000\nG68 X10 Y0 R90\nG1 X20 Y0\n"), {20, 20, 5});

    expect_near(end_of("G51 X0 Y0 Z0 P2\nG1 X10 Y3 Z4\n"), {20, 6, 8});
    expect_near(end_of("G51 X10 Y0 Z0 P500\nG1 X20 Y2\nG50\nY0\n"), {15, 0, 5});
    expect_near(end_of("G51 X0 Y0 Z0 I-1 J1 K1\nG1 X10 Y3\n"), {-10, 3, 5});
    expect_near(end_of("G51.1 X5\nG1 X10 Y3\n"), {0, 3, 5});
    expect_near(end_of("G51.1 X5\nG1 X10 Y3\nG50.1 X0\nX10\n"), {10, 3, 5});

    // Arcs turn, grow, and change their direction in a mirror.
    const auto arc_of = [&](const std::string& text) { return program_of(ready + text).moves.back(); };
    const motion::Move turned = arc_of("G1 X10\nG68 X0 Y0 R90\nG1 X10 Y0\nG3 X0 Y10 I-10\n");
    expect_near(turned.end.tip_mm, {-10, 0, 5});
    expect_near(turned.arc->centre_mm, {0, 0, 5});
    EXPECT_NEAR(turned.arc->turn_rad, kPi / 2, 1e-12);
    const motion::Move mirrored = arc_of("G51.1 X0\nG1 X10 Y0\nG3 X0 Y10 R10\n");
    expect_near(mirrored.end.tip_mm, {0, 10, 5});
    expect_near(mirrored.arc->centre_mm, {0, 0, 5});
    EXPECT_EQ(mirrored.arc->normal.z, -1);
    const motion::Move grown = arc_of("G51 X0 Y0 Z5 P3\nG1 X10 Y0\nG3 X0 Y10 I-10\n");
    EXPECT_NEAR(motion::path_length_mm(grown), 15 * kPi, 1e-9);
}

TEST(GcodeReader, SaysThatLargeCoordinatesWithoutPointsMayBeThousandths) {
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    const std::string start = "G21 M3 S900 F200\nG0 X12000 Y0 Z1000\n";
    EXPECT_TRUE(warns_of(program_of(start + "G1 Z0\n", options), 0, "thousandths of a millimetre"));
    for (const char* text : {"G1 Z0.\n", "#1=5\nG1 Z#1\n", "G1 Z[5]\n"})
        EXPECT_FALSE(warns_of(program_of(start + text, options), 0, "thousandths of a millimetre")) << text;
    EXPECT_FALSE(warns_of(program_of(start + "G1 Z0\n"), 0, "thousandths of a millimetre"));
}

TEST(GcodeReader, NamesTheKernelWhoseWordsItDoesNotRead) {
    for (const char* text : {"#VAR\nV.L.R = 5\n#ENDVAR\nG0 X5\n",
                             "G21 G0 X0 Y0 Z0\nN10 L CYCLE [NAME=A.ecy]\n", "G0 XV.L.R\n", "N5 #RTCP ON\n"}) {
        const auto program = read_gcode(text);
        ASSERT_FALSE(program.has_value()) << text;
        EXPECT_NE(program.error().cause.find("ISG kernel"), std::string::npos) << program.error().text();
    }
}

TEST(GcodeReader, TakesInchesWhereNoUnitIsStatedAndToolsAreInInches) {
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    const std::string path = "T1 M6\nM3 S900 F9\nG0 X0 Y0 Z1\nG1 X2\n";
    const motion::Program inches = program_of("(T1 1/2 END MILL)\n" + path, options);
    EXPECT_NEAR(feed_mm(inches), 50.8, 1e-9);
    EXPECT_TRUE(warns_of(inches, 4, "inches are taken, as the sizes of its tools"));
    for (const char* head : {"(T1 12 MM END MILL)\n", "(1/2 WAY THROUGH)\n", "G21 (T1 1/2 END MILL)\n",
                             "(T1 1/2 END MILL)(T2 6MM DRILL)\n", "(T1 1/2 END MILL)\nG071\n"})
        EXPECT_NEAR(feed_mm(program_of(head + path, options)), 2, 1e-9) << head;
    EXPECT_NEAR(feed_mm(program_of("(T1 1/2 END MILL)\n" + path)), 2,
                1e-9);  // of LinuxCNC: its set-up says it
}

TEST(GcodeReader, ChangesTheToolByG100OfBrother) {
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    const motion::Program program = program_of(
        "G21 G90 T1 M6\nM3 S1000 F100\nG0 X0 Y0 Z9\nG1 X1\nG100 T2 X5 Y0 Z9 G43 H2\nG1 X7\n", options);
    ASSERT_EQ(program.moves.size(), 3U);
    EXPECT_EQ(program.moves[0].tool, 1);
    EXPECT_EQ(program.moves[1].kind, motion::MoveKind::rapid);
    EXPECT_EQ(program.moves[2].tool, 2);
    EXPECT_EQ(feed_mm(program), 1 + 2);
}

}  // namespace
}  // namespace tribo::readers
