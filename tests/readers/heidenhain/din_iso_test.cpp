// SPDX-License-Identifier: MIT
// DIN/ISO programs against the same part in conversational words.
#include "readers/heidenhain/din_iso.hpp"

#include <gtest/gtest.h>
#include <string>

#include "readers/heidenhain/heidenhain_text.hpp"

namespace tribo::readers {
namespace {

motion::Program iso(const std::string& text) {
    const std::string whole =
        "%P G71 *\nN10 G99 T1 L+0 R+5 *\nN20 T1 G17 S2000 F500 *\n" + text + "N99 %P G71 *\n";
    EXPECT_TRUE(looks_like_din_iso(whole));
    return conversational(in_conversational_words(whole));
}

motion::Program plain(const std::string& text) {
    return conversational("BEGIN PGM P MM\nTOOL DEF 1 L+0 R+5\nTOOL CALL 1 Z S2000 F500\n" + text +
                          "END PGM P MM\n");
}

TEST(DinIso, MovesAsTheConversationalProgramDoes) {
    const struct {
        const char *iso, *conversational;
    } cases[] = {
        {"N30 G00 G40 G90 X-20 Y-20 Z+5 M3 *\nN40 G01 Z-5 F100 *\nN50 G91 X+5 *\nN60 G90 Y+3 *\n",
         "L X-20 Y-20 Z+5 R0 FMAX M3\nL Z-5 F100\nL IX+5\nL Y+3\n"},
        {"G00 G90 X-20 Y-20 Z+5 M3*\nG01 G41 X0 Y0 F100*\nG26 R2*\nY50*\nG25 R6*\nX50*\nG24 R3*\nY0*\nG27 "
         "R2*\n"
         "G40 X-20 Y-20*\n",
         "L X-20 Y-20 Z+5 FMAX M3\nAPPR LCT X0 Y0 R2 RL F100\nL Y50\nRND R6\nL X50\nCHF 3\nL Y0\n"
         "DEP LCT X-20 Y-20 R2\n"},
        {"G00 G90 X0 Y0 Z5 M3*\nG01 X10 F100*\nG03 X20 Y10 I10 J10*\nG02 X30 Y20 R10*\nG06 X40 Y25*\nI40 "
         "J0*\n"
         "G13 H180*\nG11 R10 H90*\nG91 G10 H30*\n",
         "L X0 Y0 Z5 FMAX M3\nL X10 F100\nCC X10 Y10\nC X20 Y10 DR+\nCR X30 Y20 R10 DR-\nCT X40 Y25\nCC X40 "
         "Y0\n"
         "CP PA180 DR+\nLP PR10 PA90\nLP IPA30 FMAX\n"},
        {"G00 G90 X0 Y0 Z5 M3*\nD00 Q1 P01 +5*\nD01 Q2 P01 +Q1 P02 +3*\nG98 L1*\nG01 G91 X+Q2 F100*\nL1,2*\n"
         "D09 P01 +Q1 P02 +5 P03 7*\nY+99*\nG98 L7*\nG90 Y+1*\nQ3=Q1*2*\nX+Q3*\n",
         "L X0 Y0 Z5 FMAX M3\nFN 0: Q1 = +5\nFN 1: Q2 = +Q1 + +3\nLBL 1\nL IX+Q2 F100\nCALL LBL 1 REP 2\n"
         "FN 9: IF +Q1 EQU +5 GOTO LBL 7\nL IY+99\nLBL 7\nL Y+1\nQ3=Q1*2\nL X+Q3\n"},
        {"G00 G90 X0 Y0 Z50 M3*\nG200 DRILLING\nQ200=2 "
         ";SET-UP\nQ201=-10\nQ206=150\nQ202=5\nQ210=0\nQ203=+0\nQ204=50\n"
         "Q211=0*\nX10 Y10 M99*\nX20*\nG79*\n",
         "L X0 Y0 Z50 FMAX M3\nCYCL DEF 200 Q200=2 Q201=-10 Q206=150 Q202=5 Q210=0 Q203=+0 Q204=50 Q211=0\n"
         "L X10 Y10 FMAX M99\nL X20 FMAX\nCYCL CALL\n"},
        {"G00 G90 X0 Y0 Z2 M3*\nG83 P01 -2 P02 -20 P03 -10 P04 0 P05 150*\nX10 Y10 M99*\n",
         "L X0 Y0 Z2 FMAX M3\nCYCL DEF 1.0\nCYCL DEF 1.1 SET UP 2\nCYCL DEF 1.2 DEPTH -20\nCYCL DEF 1.3 "
         "PECKG -10\n"
         "CYCL DEF 1.4 DWELL 0\nCYCL DEF 1.5 F150\nL X10 Y10 FMAX M99\n"},
        {"G00 G90 X0 Y0 Z2 M3*\nG54 X+10 Y+5*\nG73 H+30*\nG01 X10 Y0 F100*\nG28 X*\nX5*\nG28*\nG72 "
         "F0.5*\nX20*\nG04 F2*\n",
         "L X0 Y0 Z2 FMAX M3\nTRANS DATUM AXIS X+10 Y+5\nTRANS ROTATION ROT+30\nL X10 Y0 F100\nCYCL DEF 8.1 "
         "X\nL X5\n"
         "CYCL DEF 8.1\nTRANS SCALE SCL0.5\nL X20\nCYCL DEF 9.1 DWELL 2\n"},
    };
    for (const auto& one : cases) {
        const motion::Program read = iso(one.iso), expected = plain(one.conversational);
        ASSERT_FALSE(expected.moves.empty()) << one.iso;
        ASSERT_EQ(read.moves.size(), expected.moves.size()) << one.iso;
        for (std::size_t k = 0; k < read.moves.size(); ++k) {
            expect_near(read.moves[k].end.tip_mm, expected.moves[k].end.tip_mm, 1e-12);
            expect_near(pose_at(read.moves[k], 0.5).tip_mm, pose_at(expected.moves[k], 0.5).tip_mm, 1e-12);
            EXPECT_EQ(read.moves[k].kind, expected.moves[k].kind) << one.iso;
            EXPECT_EQ(read.moves[k].feed_mm_per_min, expected.moves[k].feed_mm_per_min) << one.iso;
        }
    }
}

TEST(DinIso, ReadsCyclesWithoutStars) {
    const std::string cycle = "Q200=2\nQ201=-5\nQ206=100\nQ202=5\nQ203=0\nQ204=9\n";
    const motion::Program program = conversational(
        in_conversational_words("%P G71\nN10 G99 T1 L+0 R+5\nN20 T1 G17 S2000 F500\nN30 G00 G90 X0 Y0 Z9 M3\n"
                                "N40 G200 DRILLING\n" +
                                cycle + "N50 X10 M99\nN9999 % P G71 *\n"));
    EXPECT_NEAR(feed_mm(program), 7, 1e-9);
}

TEST(DinIso, KeepsToolsStockAndLines) {
    const motion::Program program = conversational(in_conversational_words(
        "%P G71 *\nN10 G30 G17 X+0 Y+0 Z-20 *\nN20 G31 G90 X+100 Y+80 Z+0 *\nN30 G99 T3 L+0 R+4 "
        "*\nN40 T3 G17 S900 *\nN50 G00 X+0 Y+0 Z+0 M3 *\nN60 G02 X+10 I+5 J+0 F50 *\nN70 M2 "
        "*\nN80 G01 X99 *\n"));
    ASSERT_TRUE(program.stock.has_value());
    expect_near(program.stock->box_mm.max, {100, 80, 0});
    ASSERT_EQ(program.moves.size(), 1U);
    EXPECT_EQ(program.moves[0].line, 7);  // one line became two blocks
    EXPECT_EQ(program.moves[0].tool, 3);
    EXPECT_EQ(program.moves[0].spindle_rpm, 900);
    EXPECT_EQ(conversational(in_conversational_words("%P G70 *\nG00 X1 Y0 Z0 M3*\nG01 X2 F9*\n"))
                  .moves[0]
                  .end.tip_mm.x,
              50.8);
}

TEST(DinIso, LeavesOtherTextToItsReaders) {
    for (const char* text :
         {"%\nO1\nG71\n", "%100 (NUM)\nG1 X5\n", "%_N_A_MPF\nG71\n", "", "N10 G71 *\n", "%T,MX,\nG71\n"})
        EXPECT_FALSE(looks_like_din_iso(text)) << text;
    const Refusal refusals[] = {
        {"%P G71 *\nN10 G00 X0 Y0 Z0 *\nN20 G74 P01 -2 *\n", 3, 1, "G74"},
        {"%P G71 *\nN10 G00 X0 Y0 Z0 *\nN20 G01 X+5 ? *\n", 3, 1, "is not known"},
    };
    expect_refused(refusals, [](const std::string& text, const std::string& name) {
        GcodeOptions options;
        options.source_name = name;
        return read_heidenhain(in_conversational_words(text), options);
    });
}

}  // namespace
}  // namespace tribo::readers
