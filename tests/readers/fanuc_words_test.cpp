// SPDX-License-Identifier: MIT
// Okuma and Fagor programs in the words of a Fanuc control.
#include "readers/control/fanuc_words.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "readers/gcode/gcode_text.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

motion::Program read(std::string_view text, OtherControl control) {
    EXPECT_EQ(detect_other_control(text), control) << text;
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    return program_of(in_fanuc_words(text, control), options);
}

std::string fault(std::string_view text, OtherControl control) {
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    const auto program = read_gcode(in_fanuc_words(text, control), options);
    return program ? "" : program.error().text();
}

const std::string kOkuma =
    "$PLATE.MIN%\nO1000\n(OKUMA OSP)\nG15 H1\nG21 G90 G17 F100 S500 M3\nG56 HA\nG0 X0 Y0 Z5\n";

TEST(FanucWords, of_okuma_have_variables_jumps_and_calls) {
    // A loop of five steps of 4 mm, two calls of 3 mm, a return.
    const motion::Program program = read(kOkuma +
                                             "VC1=0\nN10 VC1=VC1+4\nG1 X=VC1 Y=[VC1*0]\nIF [VC1 LT 20] N10\n"
                                             "CALL O1001 Q2\nGOTO NEND\nG1 X99\nNEND G1 X0\nM2\n"
                                             "O1001\nDEPTH=-3\nG91 G1 Z=DEPTH\nG90\nRTS\n",
                                         OtherControl::okuma);
    EXPECT_NEAR(feed_mm(program), 20 + 6 + 20, 1e-12);
    EXPECT_EQ(program.moves.back().line, 15);
}

TEST(FanucWords, of_okuma_set_offsets_and_cycles) {
    const motion::Program program =
        read(kOkuma + "G54 X1\nG53\nG71 Z50\nG81 X10 Y10 Z-5 R2 F50 M53\nNCYL X20\nG80\nG4 F2\n",
             OtherControl::okuma);
    EXPECT_NEAR(feed_mm(program), 7, 1e-12);
    ASSERT_FALSE(program.moves.empty());
    EXPECT_DOUBLE_EQ(program.moves.back().duration_s, 2);
    EXPECT_TRUE(warns_of(program, 6, "measured right"));
}

TEST(FanucWords, of_okuma_that_have_none_are_refused) {
    EXPECT_NE(fault(kOkuma + "CALL OO88 HP=4\n", OtherControl::okuma).find("'CALL'"), std::string::npos);
    EXPECT_NE(fault(kOkuma + "CALL O1001 PX=4\n", OtherControl::okuma).find("CALL"), std::string::npos);
}

const std::string kFagor = "%PIECE,MX,\nN10 G90 G71 G17 F100 S500 M3\nN20 G0 X0 Y0 Z5\n";

TEST(FanucWords, of_fagor_have_parameters_jumps_and_subroutines) {
    const motion::Program program =
        read(kFagor +
                 "N30 (P1=0,P2=4)\nN40 (P1=P1+P2)\nN50 G1 XP1\nN60 (IF P1 LT 20 GOTO N40)\nN70 (CALL 5)\n"
                 "N80 G1 X0\nN90 M30\n(SUB 5)\nG91 G1 Z-3\nG90\n(RET)\n",
             OtherControl::fagor);
    EXPECT_NEAR(feed_mm(program), 20 + 3 + 20, 1e-12);
}

TEST(FanucWords, of_fagor_mean_what_fagor_means) {
    // Corners, drilling by Z and I, mirror images, and the end of the tool's length.
    EXPECT_NEAR(feed_mm(read(kFagor + "G1 G36 R5 X40\nY40\nG39 R2 X0\nY0\n", OtherControl::fagor)),
                35 + 5 * kPi / 2 + 35 + 38 + 2 * std::sqrt(2.0) + 38, 1e-9);
    EXPECT_NEAR(feed_mm(read(kFagor + "G99 G81 X5 Z2 I-10 F50\nX9\nG80\nG44\n", OtherControl::fagor)), 24,
                1e-12);
    const motion::Program mirrored = read(kFagor + "G11\nG1 X10 Y5\nG10\nX10\n", OtherControl::fagor);
    EXPECT_EQ(mirrored.moves.at(0).end.tip_mm, (Vec3{-10, 5, 5}));
    EXPECT_EQ(mirrored.moves.at(1).end.tip_mm, (Vec3{10, 5, 5}));
    for (const char* text : {"G8 X5 Y5\n", "G9 X5 Y5 I1 J1\n", "G93 I1 J1\n", "G69 X1 Z2 I-9\n"}) {
        EXPECT_NE(fault(kFagor + text, OtherControl::fagor).find("FAGORG"), std::string::npos) << text;
    }
    EXPECT_NE(fault(kFagor + "(RPT N10,N20) N2\n", OtherControl::fagor).find("'RPT'"), std::string::npos);
    // A comment stays one.
    EXPECT_NEAR(feed_mm(read(kFagor + "(PART 1)\nG1 X3\n", OtherControl::fagor)), 3, 1e-12);
}

TEST(FanucWords, keep_the_lines_and_leave_other_programs_alone) {
    for (const char* text :
         {"O0001\nG0 X0\n", "G21\n#1=5\nG1 X#1\n", "N10 (P 5)\nG1 X0\n", "X=5\nR1=3\n", ""}) {
        EXPECT_FALSE(detect_other_control(text).has_value()) << text;
    }
    const std::string ugly = "VC1=\n((((\nN\nX=\nIF [\nCALL\n(IF\n(P1=\nG\n\xff\xfe\nVC99999999=1\n";
    for (const OtherControl control : {OtherControl::okuma, OtherControl::fagor}) {
        const std::string translated = in_fanuc_words(ugly, control);
        EXPECT_EQ(std::count(translated.begin(), translated.end(), '\n'), 11);
    }
}

}  // namespace
}  // namespace tribo::readers
