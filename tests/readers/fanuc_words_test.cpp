// SPDX-License-Identifier: MIT
// Okuma and Fagor programs in the words of a Fanuc control.
#include "readers/control/fanuc_words.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "readers/gcode/gcode_text.hpp"
#include "readers/one_path.hpp"
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

// Okuma 5082-E, Fixture Offset Function: system PP has the zero of PH, gone with the part.
TEST(FanucWords, of_okuma_let_the_zero_go_with_the_part) {
    EXPECT_EQ(in_fanuc_words("CALL OO88 PX=0 PY=0. PZ=-0 PC=45 PA=-30 PH=1 PP=51 (A)\nG15 H51\nG15 H1\n",
                             OtherControl::okuma),
              "(A)\nG254 G54.1P1 \nG255 G54.1P1 \n");
    EXPECT_EQ(in_fanuc_words("G605 H2 Q51 R1\nG604\nG15 H1\n", OtherControl::okuma),
              "G254 G54.1P2   \nG255\nG54.1P1 \n");
}

TEST(FanucWords, of_okuma_name_programs_and_leave_out_the_machines_own) {
    // DEPTH is 1 - 4; the tip goes 3 mm down and 8 mm along X.
    const motion::Program program = read(
        "OPLATE (MAIN)\nG15 H1\nG21 G90 F100 S500 M3\nG169 HA\nG0 X0 Y0 Z0\nVSLDT[1]=50\n"
        "VC1 = 4\nG131 F9 J1 E0.01\nCALL OSTEP\nG130\nG1 X8\nG170\nCALL O9810 PX=3 PF=100\n"
        "CALL OO10 PMOD=2\nM2\nOSTEP\nDEPTH = 1 - VC1\nG1 Z=DEPTH\nRTS\n",
        OtherControl::okuma);
    EXPECT_NEAR(feed_mm(program), 3 + 8, 1e-12);
    EXPECT_DOUBLE_EQ(program.moves.back().feed_mm_per_min, 100);
    EXPECT_TRUE(warns_of(program, 13, "O9810"));
    EXPECT_TRUE(warns_of(program, 14, "O9010"));
}

TEST(FanucWords, of_okuma_tap_with_the_spindle_in_step) {
    for (const char* code : {"G274", "G284", "G273 Q1 E0", "G283 Q1 E0"}) {
        const motion::Program program =
            read(kOkuma + code + " X1 Y1 Z-5 R2 F500\nG80\n", OtherControl::okuma);
        EXPECT_NEAR(program.moves.back().end.tip_mm.z, 5, 1e-12) << code;
        EXPECT_GE(feed_mm(program), 2 * 7) << code;
    }
}

// Pecks of 2 mm from R2 to Z-9: the tool leaves the hole at 6 mm, and breaks its chips elsewhere.
TEST(FanucWords, of_okuma_clear_a_deep_hole_by_its_depth) {
    const motion::Program program =
        read(kOkuma + "G83 X0 Y0 Z-9 R2 I2 J6 F50 M54 (JIG)\nG83 X5 Z-3 R2 I2\nG80\n", OtherControl::okuma);
    std::vector<double> tops;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::rapid && move.end.tip_mm.z > move.start.tip_mm.z)
            tops.push_back(move.end.tip_mm.z);
    }
    constexpr double kLift = 0.254;
    const std::vector<double> expected{0 + kLift, -2 + kLift, 2, -6 + kLift, -8 + kLift, 2, 2, 2, 2};
    ASSERT_EQ(tops.size(), expected.size());
    for (std::size_t i = 0; i < tops.size(); ++i) EXPECT_NEAR(tops[i], expected[i], 1e-12) << i;
}

TEST(FanucWords, of_okuma_go_to_places_of_the_machine) {
    const motion::Program program =
        read(kOkuma + "G1 X4\nG16 H0 Z1000\nG16 H0 X0 Y0 (HOME)\nG0 X7 Y0 Z5\nG1 X9\n", OtherControl::okuma);
    EXPECT_NEAR(feed_mm(program), 4 + 2, 1e-12);
    EXPECT_TRUE(warns_of(program, 9, "only the machine knows"));
}

TEST(FanucWords, of_okuma_that_have_none_are_refused) {
    EXPECT_NE(fault(kOkuma + "G16 H2 X0\n", OtherControl::okuma).find("G16 of Okuma"), std::string::npos);
    EXPECT_NE(fault(kOkuma + "CALL OO88 PX=4 PH=1 PP=2\n", OtherControl::okuma).find("'CALL'"),
              std::string::npos);
    EXPECT_NE(fault(kOkuma + "CALL OO88 HP=4\n", OtherControl::okuma).find("'CALL'"), std::string::npos);
    EXPECT_NE(fault(kOkuma + "CALL O1001 VC1=4\n", OtherControl::okuma).find("CALL"), std::string::npos);
}

const std::string kFagor = "%PIECE,MX,\nN10 G90 G71 G17 F100 S500 M3\nN20 G0 X0 Y0 Z5\n";

TEST(FanucWords, of_okuma_hand_values_to_the_programs_that_they_call) {
    // Lines of 5 and 7 mm along X, each at its depth; the names of the caller keep their values.
    const motion::Program program =
        read(kOkuma +
                 "VC1=2\nLEN=40\nCALL OLINE LEN=5 DP=VC1 * 2 (FIRST)\nCALL OLINE Q2 DP=VC1 LEN=[VC1+5]\n"
                 "G1 Z=-LEN\nM2\nOLINE\nG91 G1 Z=-DP\nX=LEN\nZ=DP\nG90\nRTS\n",
             OtherControl::okuma);
    EXPECT_NEAR(feed_mm(program), (4 + 5 + 4) + 2 * (2 + 7 + 2) + 45, 1e-12);
    expect_near(program.moves.back().end.tip_mm, {19, 0, -40});
}

TEST(FanucWords, of_okuma_shift_turn_and_place_holes) {
    // The coordinates at (10, 0), turned by a quarter: 5 along their X is 5 along Y.
    const motion::Program turned =
        read(kOkuma + "G11 X10 Y0 P90\nG1 X5 Y0\nG10\nX1 Y0\nG41 X4 DA\nG40 X0\n", OtherControl::okuma);
    EXPECT_LT(distance(turned.moves.at(0).end.tip_mm, {10, 5, 5}), 1e-9);
    EXPECT_LT(distance(turned.moves.at(1).end.tip_mm, {1, 0, 5}), 1e-9);
    // Four holes on a circle of 10 mm, the first at 90 degrees; NCYL keeps the cycle from drilling before.
    const motion::Program holes =
        read(kOkuma + "NCYL G81 X0 Y0 Z-1 R1 F50\nBHC X0 Y0 I10 J90 K4\nG80\n", OtherControl::okuma);
    EXPECT_NEAR(feed_mm(holes), 4 * 2, 1e-12);
    const auto first = std::find_if(holes.moves.begin(), holes.moves.end(), [](const motion::Move& move) {
        return move.kind == motion::MoveKind::feed;
    });
    ASSERT_NE(first, holes.moves.end());
    EXPECT_LT(distance(first->end.tip_mm, {0, 10, -1}), 1e-9);
}

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
    EXPECT_EQ(detect_other_control("%00021\nT1.1\nM6\nG81 G99 X50 Y0 Z2 I-57\n"), OtherControl::fagor);
    EXPECT_NEAR(feed_mm(read(kFagor + "G96 S100\nG1 X7\n", OtherControl::fagor)), 7, 1e-12);
    const motion::Program mirrored = read(kFagor + "G11\nG1 X10 Y5\nG10\nX10\n", OtherControl::fagor);
    EXPECT_EQ(mirrored.moves.at(0).end.tip_mm, (Vec3{-10, 5, 5}));
    EXPECT_EQ(mirrored.moves.at(1).end.tip_mm, (Vec3{10, 5, 5}));
    // G73 turns the coordinates, until it stands alone: (10, 0) about (0, 0) by a quarter.
    const motion::Program turned = read(kFagor + "G73 Q90\nG1 X10 Y0\nG73\nX10 Y0\n", OtherControl::fagor);
    EXPECT_LT(distance(turned.moves.at(0).end.tip_mm, {0, 10, 5}), 1e-9);
    EXPECT_LT(distance(turned.moves.at(1).end.tip_mm, {10, 0, 5}), 1e-9);
    // What means something else on a Fanuc control is refused by its name: pockets, patterns, the home
    // search.
    for (const char* text :
         {"G8 R5 Q5\n", "G9 X5 Y5 I1\n", "G69 X1 Z2 I-9\n", "G74 X Y\n", "G87 Z2 I-10 J20 K10 B3\n",
          "G88 Z2 I-10 J20 B3\n", "G63 X5 Y0 I30 K3\n", "G73 Q90\nG73 Q10\n"}) {
        EXPECT_NE(fault(kFagor + text, OtherControl::fagor).find("of Fagor controls"), std::string::npos)
            << text;
    }
    EXPECT_NE(fault(kFagor + "(RPT 10,20)\n", OtherControl::fagor).find("'RPT'"), std::string::npos);
    // A comment stays one.
    EXPECT_NEAR(feed_mm(read(kFagor + "(PART 1)\nG1 X3\n", OtherControl::fagor)), 3, 1e-12);
}

void expect_same(std::string_view text, OtherControl control, const std::string& gcode) {
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    expect_one_path(read(text, control), read_gcode(gcode, options), std::string(text).c_str());
}

TEST(FanucWords, of_fagor_repeat_lines) {
    const std::string start = "G90 G21 G17 F100 S500 M3\nG0 X0 Y0 Z5\n", step = "G91 G1 X2\nY3\nG90\n";
    const std::string once = "N30 G91 G1 X2\nN40 Y3\nN50 G90\n";
    // N2: twice more, behind the lines and within a repetition of its own.
    expect_same(kFagor + once + "N60 (RPT N30,N50) N2\nN70 G1 X0\n", OtherControl::fagor,
                start + step + step + step + "G1 X0\n");
    expect_same(kFagor + once + "N60 (RPT N30,N50)\nN65 Z7\nN70 (RPT N60,N65) N2\nN80 X0\n",
                OtherControl::fagor, start + step + step + "Z7\n" + step + "Z7\n" + step + "Z7\nX0\n");
    EXPECT_NE(fault(kFagor + once + "(RPT N40,N99) N2\n", OtherControl::fagor).find("have no N99"),
              std::string::npos);
    EXPECT_NE(fault(kFagor + "N30 X1\n(RPT N30,N50)\nN50 X2\n", OtherControl::fagor).find("their own call"),
              std::string::npos);
}

TEST(FanucWords, of_fagor_have_arcs_by_centre_and_by_three_points) {
    const std::string start = "G90 G21 G17 F100 S500 M3\nG0 X0 Y0 Z5\n";
    expect_same(kFagor + "G1 X10 Y5\nG06 G3 X20 Y15 I10 J15\nG3 X30 Y25 I0 J10\n", OtherControl::fagor,
                start + "G1 X10 Y5\nG3 X20 Y15 I0 J10\nG3 X30 Y25 I0 J10\n");
    // Tangent arcs: two quarters to the left and one to the right; behind a rapid, and in a mirror image.
    expect_same(kFagor +
                    "G1 X10\nG8 X20 Y10\nG08 X10 Y20\nG8 X0 Y30\nG1 X5\nG91 G8 Y4\nG90 G0 X0 Y0\nG0 Y10\nG8 "
                    "X-5 Y15\nG11\nG1 X10 Y15\nG8 X20 Y25\n",
                OtherControl::fagor,
                start +
                    "G1 X10\nG3 X20 Y10 I0 J10\nG3 X10 Y20 I-10 J0\nG2 X0 Y30 I0 J10\nG1 X5\nG3 Y34 I0 J2\n"
                    "G0 X0 Y0\nG0 Y10\nG3 X-5 Y15 I-5 J0\nG1 X-10 Y15\nG2 X-20 Y25 I0 J10\n");
    // Half a circle about (10, 0), to the left and to the right; then as increments.
    expect_same(kFagor +
                    "G1 X0\nG9 X20 Y0 I10 J10\nG9 X40 Y0 I30 J-10\nG91 G9 X10 Y10 I2.92893218813452 "
                    "J7.07106781186548\n",
                OtherControl::fagor,
                start + "G1 X0\nG2 X20 Y0 I10 J0\nG3 X40 Y0 I10 J0\nG2 X50 Y10 I10 J0\n");
}

// What begins the programs of both below.
const std::string kNum = "%1000\n(PLATE)\nG71 G90 G17 G40 G80 D1\nF100 S500 M03\nG0 X0 Y0 Z5\n";
const std::string kNumInFanuc = "O1000\nG21 G90 G17\nF100 S500 M3\nG0 X0 Y0 Z5\n";

// Fagor 8055 M/EN programming manual, pages 48 and 90.
TEST(FanucWords, of_fagor_have_polar_coordinates) {
    const std::string start = "G90 G21 G17 F100 S500 M3\nG0 X0 Y0 Z5\n";
    const std::string cartesian = start + "G0 X60 Y40\nG1 Z-1\nG3 X110 Y90 I0 J50\nG3 X160 Y40 I50 J0\n";
    expect_same(kFagor + "G0 X60 Y40\nG1 Z-1\nG90 G17 G03 Q0 I0 J50\nQ-90 I50 J0\n", OtherControl::fagor,
                cartesian);
    expect_same(kFagor + "G0 X60 Y40\nG1 Z-1\nG93 I60 J90\nG03 Q0\nG93 I160 J90\nQ-90\n", OtherControl::fagor,
                cartesian);
    // About the zero: lines and arcs; about the place of the tool; by increments and parameters.
    expect_same(kFagor + "G1 R100 Q0\nG3 Q30\nG1 R50\nG3 Q90 Z4\nG93\nG1 R10 Q180\n(P1=10)\nR=P1*2 Q0\n",
                OtherControl::fagor,
                start +
                    "G1 X100\nG3 X[100*COS[30]] Y50 R100\nG1 X[50*COS[30]] Y25\nG3 X0 Y50 Z4 R50\n"
                    "G1 X-10\nX20\n");
    expect_same(kFagor + "G1 R20 Q0\nG91 R10 Q90\nG3 Q90\nG90 G1 X0 Y0\n", OtherControl::fagor,
                start + "G1 X20\nX0 Y30\nG3 X-30 Y0 R30\nG1 X0\n");
    EXPECT_NE(fault(kFagor + "G18 G1 R20 Q0\n", OtherControl::fagor).find("FAGORPOLAR"), std::string::npos);
}

TEST(FanucWords, of_num_have_variables_jumps_and_calls) {
    // A loop of three steps, lines again, a subprogram twice, a name, a word without a number.
    expect_same(
        kNum +
            "L0=0 L1 = 4\nN10 L0 = L0+L1\nG1 XL0 Y-L1\nG79 L0 < 12 N10\nG77 N20 N30 S2\n"
            "N20 G91 Z-1\nN30 G90 X\nG77 H50 S2\nG79 N90\nX99\nN90 [DEPTH]=-3\nZ[DEPTH] F[RATE]\nM02\n"
            "%50 (STEP)\nG91 Y2\nG90\n%60\nX5\n",
        OtherControl::num,
        kNumInFanuc +
            "G1 X4 Y-4\nX8\nX12\nG91 Z-1\nG90 X0\nG91 Z-1\nG90 X0\nG91 Z-1\nG90 X0\nG91 Y2\n"
            "Y2\nG90 Z-3\nM2\n");
    const motion::Program counted = read(kNum + "G79 N40\nX9\nN40 G1 X7\n", OtherControl::num);
    EXPECT_EQ(counted.moves.back().line, 8);
}

TEST(FanucWords, of_num_have_corners_cycles_and_dwells) {
    expect_same(kNum + "G79 N5\nN5 G1 X40 EB5\nY40 EB-2\nX0\nG4 F2\n", OtherControl::num,
                kNumInFanuc + "G1 X40 ,R5\nY40 ,C2\nX0\nG4 X2.\n");
    // The tool returns to the plane of ER, or to where it is.
    expect_same(kNum + "G0 Z20\nG81 X10 Y5 Z-8 ER2 F60\nX30\nG80\nG83 X50 Z-6 ER1 P2 F80\nG80 Z20\n",
                OtherControl::num,
                kNumInFanuc +
                    "G0 Z20\nG99 G81 X10 Y5 Z-8 R2 F60\nX30\nG80\nG99 G83 X50 Y5 Z-6 R1 Q2 F80\nG80\n"
                    "G0 Z20\n");
    expect_same(kNum + "G79 N5\nN5 G87 X10 Z-5 P2 F60\nG80\nG82 X20 Z-3 ER2 EF1.5\nG80\n", OtherControl::num,
                kNumInFanuc + "G99 G73 X10 Y0 Z-5 R5 Q2 F60\nG80\nG99 G82 X20 Z-3 R2 P1500\nG80\n");
    expect_same(kNum + "G79 N5\nN5 G59 X10 Y20\nG1 X5 Y5 $ A MESSAGE\nG59 X Y\nG16 R+\nX1 Y1\n",
                OtherControl::num, kNumInFanuc + "G52 X10 Y20\nG1 X5 Y5\nG52 X0 Y0\nX1 Y1\n");
}

TEST(FanucWords, of_num_that_have_none_are_refused) {
    const std::pair<const char*, const char*> cases[] = {
        {"G45 X1 Y1 Z-5 EX9 EY9\n", "G45 of NUM"},
        {"G1 X5 EA30\n", "EA of NUM"},
        {"L1=L2+L3*2\n", "ORDER of NUM"},
        {"L1=SL2\n", "FUNCTION of NUM"},
        {"G79 L1 5 N10\n", "G79 of NUM"},
        {"G77 H5 N1 N2\n", "G77 of NUM"},
        {"E60001=5\n", "of NUM"},
        {"G81 X1 Z-5 EH2\n", "EH of NUM"},
        {"G83 Z-5 ER1 ES3\n", "ES of NUM"},
        {"G59 I1 J1 ED30\n", "G59 of NUM"},
        {"G53\n", "G53 of NUM"},
        {"G51 X-\n", "G51 of NUM"},
        {"G16 P+\n", "G16 of NUM"},
        {"G1 X5 EBL1\n", "EB of NUM"},
        {"G10 X5\n", "G10 of NUM"},
        {"G12\n", "G12 of NUM"},
        {"ED45\n", "ED of NUM"},
        {"G88 X1 Z-5 ER1\n", "G88 of NUM"},
    };
    for (const auto& [text, name] : cases) {
        EXPECT_NE(fault(kNum + "G79 N5\nN5\n" + text, OtherControl::num).find(name), std::string::npos)
            << text << fault(kNum + "G79 N5\nN5\n" + text, OtherControl::num);
    }
}

// What begins the programs below: the work system by E, the length by H and Z.
const std::string kFadalStart = "M6 T1\nG0 G90 S900 M3 X0 Y0 E1\nH1 Z5.\nG8\n";
const std::string kFadalInFanuc = "G21 M6 T1\nG0 G90 S900 M3 G54.1 P1 X0 Y0\nG43 H1 Z5\n";

TEST(FanucWords, of_fadal_have_systems_lengths_and_taps) {
    const std::string start = "O5 (PLATE)\n" + kFadalStart;
    expect_same(start +
                    "G1 Z-1 F60\nX10\n* A COMMENT\nN8 G0 Z5\nG84.2\nG84.1 G99 X20 R0+3. Z-6 F100\nG80\n"
                    "G0 G90 H0 Z0.\nE0 X0. Y250.\nX9\nM2\n",
                OtherControl::fadal,
                kFadalInFanuc + "G1 Z-1 F60\nX10\nG0 Z5\nG99 G84 X20 R3 Z-6 F100\nG80\nM2\n");
    EXPECT_EQ(detect_other_control("E1\nG0 X0 Y0\nH1 Z5\n"), OtherControl::fadal);
    EXPECT_TRUE(warns_of(read(start + "G1 X5 F60\nG90 H0 Z0\nX7\n", OtherControl::fadal), 7,
                         "only the machine knows"));
}

TEST(FanucWords, of_fadal_have_subroutines_before_the_main_program) {
    // Two holes, then a ring of four turns to Z-2 and of two more there.
    const motion::Program program =
        read("%\nO5\nL100\nX4 Y0\nX8.\nM17\nL200 (RING)\nG91 G3 I-2 Z-0.5 L4\nG3 I-2. L2\nG90\nM17\nM30\n" +
                 kFadalStart + "G99 G81 R2 Z-3 F60 L0\nL101\nG80\nG1 Z0\nL201\nM2\n",
             OtherControl::fadal);
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    expect_one_path(
        program,
        read_gcode(kFadalInFanuc + "G99 G81 R2 Z-3 F60 X4\nX8\nG80\nG1 Z0\nG3 I-2 Z-2 P4\nG3 I-2 P2\nM2\n",
                   options),
        "Fadal");
    EXPECT_EQ(program.moves.back().line, 9);
}

TEST(FanucWords, of_fadal_that_have_none_are_refused) {
    for (const char* text : {"G91 G1 X5 L3\n", "G3 I-2 Z-1 L3\n", "L5\n", "G91 G3 X1 I2 L3\n"}) {
        EXPECT_NE(fault(kFadalStart + text, OtherControl::fadal).find("L of Fadal"), std::string::npos)
            << text;
    }
    EXPECT_NE(fault(kFadalStart + "X1 E60\n", OtherControl::fadal).find("E of Fadal"), std::string::npos);
    EXPECT_NE(fault(kFadalStart + "X1.2.3\n", OtherControl::fadal), "");
    EXPECT_NE(fault(kFadalStart + "X1.2.\n", OtherControl::fadal), "");
}

TEST(FanucWords, keep_the_lines_and_leave_other_programs_alone) {
    for (const char* text : {"O0001\nG0 X0\n", "G21\n#1=5\nG1 X#1\n", "N10 (P 5)\nG1 X0\n", "X=5\nR1=3\n",
                             "G43 H1 Z5\nX0 Y0 E1\n", "G81 X5 Z-9 R2 I3\n", "G83 Z-9 I3 J1 K1\n",
                             "G84 Z-9 (BY I)\n", "G1 X5 Y5 E1\nG1 Z2\n", ""}) {
        EXPECT_FALSE(detect_other_control(text).has_value()) << text;
    }
    const std::string ugly = "VC1=\n((((\nN\nX=\nIF [\nCALL\n(IF\n(P1=\nG\n\xff\xfe\nVC99999999=1\n";
    for (const OtherControl control :
         {OtherControl::okuma, OtherControl::fagor, OtherControl::num, OtherControl::fadal}) {
        const std::string translated = in_fanuc_words(ugly, control);
        EXPECT_EQ(std::count(translated.begin(), translated.end(), '\n'), 11);
    }
}

}  // namespace
}  // namespace tribo::readers
