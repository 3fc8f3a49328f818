// SPDX-License-Identifier: MIT
// NCI files of Mastercam: the same paths as in G-code and APT, and what is refused.
#include <gtest/gtest.h>
#include <string>

#include "readers/gcode/reader.hpp"
#include "readers/nci/reader.hpp"
#include "readers/one_path.hpp"
#include "readers/refusals.hpp"

namespace tribo::readers {
namespace {

// A tool of 10 mm with number 3 at 4000 turns, as an operation begins.
const std::string kStart =
    "1050\n9 3 25 11 2026 12 0 0 PART.MCX\n1013\n0 10. 0. 0 0\n1014\n1. 0. 0. 0. 1. 0. 0. 0. 1.\n"
    "20001\n10. FLAT ENDMILL\n1002\n0 100 10 3 3 3 0 4000. 500. 1 0 0 0 0. 0. 250.\n";

motion::Program nci(const std::string& text, const AptOptions& options = {}) {
    const auto program = read_nci(text, options);
    if (!program) {
        ADD_FAILURE() << program.error().text() << "\nin:\n" << text;
        return {};
    }
    return *program;
}

Result<motion::Program> gcode(const std::string& text, GcodeDialect dialect = GcodeDialect::linuxcnc) {
    GcodeOptions options;
    options.dialect = dialect;
    return read_gcode("G21 G90 G17\nT3 M6\nS4000 M3\n" + text, options);
}

TEST(Nci, LinesAndArcsOfThreePlanesAreThoseOfGcode) {
    const auto program = nci(kStart +
                             "0\n0 0. 0. 10. -2. 0\n0\n0 0. 0. 2. -2. 0\n1\n0 0. 0. -3. 200. 0\n"
                             "1\n0 40. 0. -3. 500. 0\n3\n0 0 60. 20. 40. 20. -3. -1. 0 0\n"
                             "2\n0 0 80. 40. 80. 20. -3. 300. 0 0\n1\n0 100. 40. -3. -1. 0\n"
                             // A helix, a full circle, and arcs in YZ and XZ.
                             "3\n0 0 80. 40. 90. 40. -5. -1. 0 0\n3\n0 0 80. 40. 90. 40. -5. -1. 0 1\n"
                             "3\n1 0 60. -5. 50. -5. 80. -1. 0 0\n2\n2 0 100. -5. 90. -5. 60. -1. 0 0\n"
                             "0\n0 100. 60. 10. -2. 0\n1003\n0\n");
    expect_one_path(
        program,
        gcode("G0 X0 Y0 Z10\nZ2\nG1 Z-3 F200\nX40 F500\nG3 X60 Y20 I0 J20\nG2 X80 Y40 I20 J0 F300\n"
              "G1 X100\nG3 X80 Y40 Z-5 I-10 J0\nG3 X80 Y40 I10 J0\nG19 G3 Y60 Z-5 J10 K0\n"
              "G18 G2 X100 Z-5 I10 K0\nG17 G0 Z10\n"),
        "G-code");
    EXPECT_NEAR(feed_mm(program),
                5 + 40 + 20 + 10 * math::kPi + 10 * math::kPi + std::hypot(10 * math::kPi, 2) +
                    20 * math::kPi + 2 * 10 * math::kPi,
                1e-9);
    ASSERT_FALSE(program.moves.empty());
    EXPECT_EQ(program.moves.back().tool, 3);
    EXPECT_EQ(program.moves.back().spindle_rpm, 4000);
    EXPECT_EQ(program.moves[1].feed_mm_per_min, 200);
    ASSERT_EQ(program.tools.size(), 1U);
    EXPECT_EQ(program.tools[0].number, 3);
    EXPECT_EQ(program.tools[0].diameter_mm, 10);
    EXPECT_EQ(program.dialect, "Mastercam NCI");
    EXPECT_TRUE(warns_of(program, 11, "states no unit: millimetres"));
}

TEST(Nci, InchesAreTheUnitOfTheOptions) {
    AptOptions inches;
    inches.default_unit = LengthUnit::inch;
    const auto program = nci("1000\n0 0 0 1 0 0 0 900.\n1\n0 0. 0. 1. 10. 0\n1\n0 2. 0. 1. 20. 0\n", inches);
    ASSERT_EQ(program.moves.size(), 1U);
    EXPECT_NEAR(program.moves[0].end.tip_mm.x, 50.8, 1e-12);
    EXPECT_NEAR(program.moves[0].feed_mm_per_min, 508, 1e-12);
}

TEST(Nci, FiveAxisPointsHaveTheDirectionOfTheirSecondPoint) {
    const auto program = nci(kStart +
                             "11\n0. 0. 10. 0. 0. 35. -2. 0 0 0. 0. 1.\n"
                             "11\n10. 0. 10. 16. 0. 18. 400. 0 0 0. 0. 1.\n"
                             "11\n20. 0. 10. 32. 16. 30. -1. 0 0 0. 0. 1.\n");
    ASSERT_EQ(program.moves.size(), 2U);
    expect_near(program.moves[0].end.axis, {0.6, 0, 0.8});
    expect_near(program.moves[1].end.axis, Vec3{12, 16, 20} / std::sqrt(800));
    EXPECT_EQ(program.moves[1].feed_mm_per_min, 400);
    expect_near(program.moves[1].end.tip_mm, {20, 0, 10});
}

TEST(Nci, HolesAreThoseOfTheCyclesOfGcode) {
    // Drilled with a dwell, and a second hole whose bottom lies deeper; then in pecks.
    const std::string holes =
        "0\n0 10. 0. 25. -2. 0\n81\n0 10. 0. -8. 0.5 120. 0. 0. 0. 0. 25. 2. 0. 0. 10. 0. 25. 0 0\n"
        "100\n0 30. 0. -10. 25. 2. 0.5 120. 30. 0. 25. 0 0\n80\n0\n";
    expect_one_path(nci(kStart + holes),
                    gcode("G0 X10 Y0 Z25\nG98 G82 X10 Y0 Z-8 R2 P0.5 F120\nG82 X30 Z-10\nG80\n"), "drilled");
    const std::string pecks =
        "0\n0 10. 0. 2. -2. 0\n81\n1 10. 0. -8. 0. 120. 4. 4. 0. 0. 2. 2. 0. 0. 10. 0. 2. 0 0\n80\n0\n";
    expect_one_path(nci(kStart + pecks), gcode("G0 X10 Y0 Z2\nG98 G83 X10 Y0 Z-8 R2 Q4 F120\nG80\n"),
                    "pecks");
    // A bore goes out at feed; a hole along +x begins where its heights say.
    const auto bored = nci(
        kStart + "0\n0 60. 0. 5. -2. 0\n81\n4 10. 0. 5. 0. 120. 0. 0. 0. 0. 60. 42. 40. 0. 60. 0. 5. 0 0\n");
    ASSERT_EQ(bored.moves.size(), 5U);  // the first one turns the tool
    expect_near(bored.moves[1].end.tip_mm, {42, 0, 5});
    expect_near(bored.moves[2].end.tip_mm, {10, 0, 5});
    EXPECT_EQ(bored.moves[3].kind, motion::MoveKind::feed);
    expect_near(bored.moves[4].end.tip_mm, {60, 0, 5});
    expect_near(bored.moves[2].end.axis, {1, 0, 0});
}

TEST(Nci, WhatMovesNothingIsPassedOver) {
    const auto program =
        nci("1050\n9 3 0 PART\n1005\nA comment, with words\n1016\n1 2 3\n10000\n\n1044\n5\n1044\n6\n"
            "0\n0 0. 0. 1. -2. 0\n0\n0 5. 0. 1. -2. 0\n4\n2. 0.\n1003\n0\n not read\n");
    ASSERT_EQ(program.moves.size(), 2U);
    EXPECT_EQ(program.moves[1].duration_s, 2);
    EXPECT_TRUE(warns_of(program, 9, "records 1044 are not known"));
    EXPECT_EQ(program.warnings.size(), 2U);
    const auto compensated = nci(kStart + "0\n0 0. 0. 1. -2. 0\n1\n41 5. 0. 1. 100. 0\n");
    EXPECT_TRUE(warns_of(compensated, 14, "compensation in the control"));
    const auto turned = nci("1014\n0. 1. 0. -1. 0. 0. 0. 0. 1.\n0\n0 0. 0. 1. -2. 0\n0\n0 5. 0. 1. -2. 0\n");
    EXPECT_TRUE(warns_of(turned, 1, "a turned system (record 1014)"));
}

TEST(Nci, IsToldByItsPairsOfLines) {
    EXPECT_TRUE(looks_like_nci(kStart));
    EXPECT_TRUE(looks_like_nci("\r\n1000\r\n0 0 0 1\r\n"));
    EXPECT_TRUE(looks_like_nci("20001\nTOOL\n1016\n1 2\n"));
    EXPECT_FALSE(looks_like_nci(""));
    EXPECT_FALSE(looks_like_nci("0\n0 1. 2. 3. 4. 0\n"));
    EXPECT_FALSE(looks_like_nci("1050\n"));
    EXPECT_FALSE(looks_like_nci("1000\n0 0\nG0 X1\nG1\n"));
    EXPECT_FALSE(looks_like_nci("O1000\nG0 X1\n"));
}

TEST(Nci, RefusesWhatItDoesNotKnow) {
    const Refusal refusals[] = {
        {"", 0, 0, "no NCI record"},
        {"1000\n0 0 0 1 0 0 0 900.\nG0 X1\n", 3, 1, "'G0 X1' stands where the number of a record is due"},
        {"0\n0 0. 0. 1. -2. 0\n3\n0 0 5. 5. 0. 5. 1. -2. 0 0\n5\n1 2 3\n", 5, 1, "record 5 is not known"},
        {"0\n0 1. 2.\n", 1, 1, "record 0 has 3 values, and needs 5"},
        {"1\n0 1. 2. 3. 100. 0\n1\n0 1. x 3. 100. 0\n", 4, 6, "'x' is not a number"},
        {"1\n0 1. 2. 3. 100. 0\n1\n0 1. 3. 3. -7. 0\n", 4, 12, "feed"},
        {"1\n0 1. 2. 3. -1. 0\n1\n0 1. 3. 3. -1. 0\n", 3, 1, "a feed move before any FEDRAT"},
        {"2\n0 0 1. 0. 0. 0. 0. 100. 0\n", 1, 1, "an arc before any point"},
        {"0\n0 0. 0. 0. -2. 0\n2\n3 0 10. 0. 5. 0. 0. 100. 0\n", 4, 1, "an arc in no plane"},
        {"0\n0 0. 0. 0. -2. 0\n2\n0 0 10. 0. 10. 0. 0. 100. 0\n", 3, 1, "an arc whose end is its centre"},
        {"0\n0 0. 0. 0. -2. 0\n2\n0 0 10. 0. 6. 0. 0. 100. 0\n", 3, 1, "from the axis of its circle"},
        {"11\n0. 0. 0. 0. 0. 0. 100. 0 0\n", 2, 10, "the two points of the tool's axis are one"},
        {"1014\n1. 0. 0. 0. 0. -1. 0. 1. 0.\n11\n0. 0. 0. 0. 0. 1. 100. 0 0\n", 3, 1, "tilted tool plane"},
        {"1014\n1. 0. 0. 0. 1. 0. 0. 0. 1.\n1014\n1. 0. 0. 0. 0. -1. 0. 1. 0.\n", 4, 13,
         "a second tool plane"},
        {"1027\n1. 0. 0. 0. 1. 0. 0. 0. 1. 0. 0. 0.\n1027\n1. 0. 0. 0. 1. 0. 0. 0. 1. 5. 0. 0.\n", 4, 28,
         "a second work system"},
        {"1018\n1 2\n", 1, 1, "a subprogram (record 1018)"},
        {"100\n0 30. 0. -10. 25. 2. 0.5 120. 30. 0. 25. 0 0\n", 1, 1, "a further hole without a first one"},
        {"81\n7 10. 0. -8. 0. 120. 0. 0. 0. 0. 25. 2. 0. 0. 10. 0. 25. 0 0\n", 2, 1,
         "a cycle of its own ('7')"},
        {"81\n0 10. 0. -8. 0. 120. 0. 0. 0. 0. 25. 26. 0. 0. 10. 0. 25. 0 0\n", 1, 1,
         "a hole whose feed does not begin between"},
        {"81\n0 10. 0. -8. 0. 120. 0. 0. 0. 0. 25. 2. 0. 0. 10. 0. 30. 0 0\n", 1, 1,
         "the height of the start is not that of its point"},
        {"81\n1 10. 0. -8. 0. 120. 0.0001 0. 0. 0. 25. 2. 0. 0. 10. 0. 25. 0 0\n", 1, 1, "10000 pecks"},
        {"1013\n0 -5. 0.\n", 2, 3, "a cutter without a diameter"},
        {"1002\n0 0 0 1.5 0 0 0 900.\n", 2, 7, "not a whole number"},
    };
    expect_refused(refusals, [](const std::string& text, const char* name) {
        AptOptions options;
        options.source_name = name;
        return read_nci(text, options);
    });
}

TEST(Nci, GivesAllItsRefusalsWhereTheyAreWanted) {
    std::vector<Error> refusals;
    AptOptions options;
    options.refusals = &refusals;
    const auto program = read_nci("1018\n1\n5\n1\n0\n0 0. 0. 0. -2. 0\n1\n0 1. 0. 0.\n", options);
    EXPECT_FALSE(program.has_value());
    EXPECT_EQ(refusals.size(), 3U);
}

}  // namespace
}  // namespace tribo::readers
