// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "motion/algebra/direction.hpp"
#include "readers/gcode/gcode_text.hpp"
#include "readers/real_files.hpp"

namespace tribo::readers {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

// A program on a machine of a name, with the stock's zero where it is said to be.
motion::Program on(const char* name, std::string_view text, Vec3 stock_mm = {}) {
    motion::Machine machine = *motion::named_machine(name);
    machine.stock_mm = stock_mm;
    GcodeOptions options;
    options.machine = &machine;
    return program_of(text, options);
}

// What is wrong with a program on a machine.
std::string fault(const char* name, std::string_view text) {
    const motion::Machine machine = *motion::named_machine(name);
    GcodeOptions options;
    options.source_name = "p.nc";
    options.machine = &machine;
    const auto program = read_gcode(text, options);
    return program ? "" : program.error().text();
}

double seconds(const motion::Program& program) {
    double sum = 0;
    for (const motion::Move& m : program.moves) {
        if (m.kind != motion::MoveKind::feed) continue;
        sum += m.duration_s > 0 ? m.duration_s : 60 * path_length_mm(m) / m.feed_mm_per_min;
    }
    return sum;
}

void expect_joined(const motion::Program& program) {
    for (std::size_t i = 1; i < program.moves.size(); ++i) {
        EXPECT_LT(distance(program.moves[i].start.tip_mm, program.moves[i - 1].end.tip_mm), 1e-9) << i;
        EXPECT_LT(distance(program.moves[i].start.axis, program.moves[i - 1].end.axis), 1e-9) << i;
    }
}

// The part turns by A about x after C about z: what stands at `p` on the machine, seen from the part.
Vec3 unturned(Vec3 p, double a, double c) {
    const Vec3 q{p.x, std::cos(a) * p.y + std::sin(a) * p.z, -std::sin(a) * p.y + std::cos(a) * p.z};
    return {std::cos(c) * q.x + std::sin(c) * q.y, -std::sin(c) * q.x + std::cos(c) * q.y, q.z};
}

TEST(GcodeRotary, LetsTheZeroTurnWithThePart) {
    // B90 of a table turns the part by -90 degrees about y: what stands 5 above its zero lies along its +x.
    const std::string head = "G21 G90 M3 F100\nG0 X0 Y0 Z50 B0 C0\n", turned = "B90\nX0 Y7 Z5\nG1 Z2\n";
    for (const char* on_off : {"G254\n", "G54.2 P1\n"}) {
        const motion::Program program =
            on("haas-umc", head + on_off + turned + "G255\nG54.2 P0\n", {10, 20, 30});
        const motion::ToolPose end = program.moves.back().end;
        EXPECT_LT(distance(end.tip_mm, {2, 7, 0}), 1e-9);
        EXPECT_LT(distance(end.axis, {1, 0, 0}), 1e-9);
        expect_joined(program);
    }
    // A stock whose zero lies on the axes needs no such code.
    EXPECT_LT(distance(on("haas-umc", head + turned).moves.back().end.tip_mm, {2, 7, 0}), 1e-9);
    EXPECT_GT(distance(on("haas-umc", head + turned, {10, 20, 30}).moves.back().end.tip_mm, {2, 7, 0}), 1);
    // Switching it moves nothing, and later words count from the machine again.
    const motion::Program back =
        on("haas-umc", head + "G254\n" + turned + "G255\nG91 G1 X1 Y0 Z0\n", {10, 20, 30});
    EXPECT_LT(distance(back.moves.back().end.tip_mm, {2, 7, -1}), 1e-9);
    expect_joined(back);
}

// A program without G43.5 whose I J K all have the length 1.
TEST(GcodeRotary, TakesVectorsOfLengthOneAsTheToolsAxis) {
    const std::string text =
        "G0 X1 Y2 Z3 I0 J0 K1\nG1 X2 I0.6 J0 K0.8 F100\nX3 I-0.577 J0.577 K0.577\nX4 Y5\n";
    const motion::Program program = program_of(text);
    ASSERT_EQ(program.moves.size(), 3U);
    expect_near(program.moves[0].end.axis, {0.6, 0, 0.8});
    expect_near(program.moves[1].end.axis, normalized(Vec3{-1, 1, 1}), 1e-12);
    expect_near(program.moves[2].end.axis, program.moves[1].end.axis);
    EXPECT_TRUE(warns_of(program, 0, "as with G43.5"));
    // All of them downwards.
    const motion::Program down =
        program_of("G0 X1 Y2 Z3 I0 J0 K-1\nG1 X2 I-0.6 J0 K-0.8 F100\nX3 I-0.6 J0 K-0.8\n");
    expect_near(down.moves.back().end.axis, {0.6, 0, 0.8});
    EXPECT_TRUE(warns_of(down, 0, "from the shank to the tip"));
    // Two blocks, another length, an arc, or one of the three missing are no sign.
    for (const char* other : {"G0 X1 Y2 Z3 I0 J0 K1\nG1 X2 I0.6 J0 K0.8 F100\n",
                              "G0 X1 Y2 Z3 I0 J0 K1\nG1 X2 I0.6 J0 K0.8 F100\nX3 I1 J1 K0\n",
                              "G0 X1 Y2 Z3 I0 J0 K1\nG1 X2 I0.6 J0 K0.8 F100\nX3 I0 J1 K0\nG2 X5 I1 J0\n",
                              "G0 X1 Y2 Z3 I0 J0 K1\nG1 X2 I0.6 J0 K0.8 F100\nX3 I0 J1\n"}) {
        const auto refused = read_gcode(other);
        ASSERT_FALSE(refused.has_value()) << other;
        EXPECT_NE(refused.error().cause.find("without an arc to use it"), std::string::npos)
            << refused.error().text();
    }
}

TEST(GcodeRotary, WithoutTipControlTurnsThePartUnderTheTool) {
    const motion::Program program =
        on("xyzac-trt", "G21 G0 X0 Y0 Z50\nA30 C40\nG1 X10 Y-20 Z5 F100\nG2 X20 Y-10 I10 J0\n");
    ASSERT_EQ(program.machine, "xyzac-trt");
    expect_joined(program);
    const double a = 30 * kDeg, c = 40 * kDeg;
    const motion::Move& line = program.moves[program.moves.size() - 2];
    const motion::Move& arc = program.moves.back();
    expect_near(line.start.tip_mm, unturned({0, 0, 50}, a, c), 1e-9);
    expect_near(line.end.tip_mm, unturned({10, -20, 5}, a, c), 1e-9);
    expect_near(line.end.axis, unturned({0, 0, 1}, a, c), 1e-12);
    EXPECT_EQ(line.duration_s, 0);
    ASSERT_TRUE(arc.arc);
    EXPECT_NEAR(path_length_mm(arc), 10 * 0.5 * std::numbers::pi, 1e-9);
    expect_near(pose_at(arc, 0.5).tip_mm,
                unturned({20 - 10 * std::sqrt(0.5), -20 + 10 * std::sqrt(0.5), 5}, a, c), 1e-9);
}

TEST(GcodeRotary, WithTipControlLeadsTheTipStraightWhileTheAxesTurn) {
    for (const char* on_code : {"M428", "M128", "G43.4 H1", "G234", "G169"}) {
        const motion::Program program =
            on("xyzac-trt", std::string("G21 G0 X0 Y0 Z50\n") + on_code + "\nG1 X30 Y0 Z50 A30 C90 F600\n");
        expect_joined(program);
        EXPECT_NEAR(feed_mm(program), 30, 1e-9) << on_code;
        EXPECT_NEAR(seconds(program), 3, 1e-9) << on_code;
        expect_near(program.moves.back().end.tip_mm, {30, 0, 50}, 1e-9);
        expect_near(program.moves.back().end.axis, unturned({0, 0, 1}, 30 * kDeg, 90 * kDeg), 1e-12);
        // Half way along the line the joints are half way.
        double run = 0;
        for (const motion::Move& move : program.moves) {
            for (const double t : {0.0, 0.3, 0.8}) {
                const motion::ToolPose pose = pose_at(move, t);
                const double u = pose.tip_mm.x / 30;
                EXPECT_LT(motion::angle_rad(pose.axis, unturned({0, 0, 1}, u * 30 * kDeg, u * 90 * kDeg)),
                          3e-6);
                EXPECT_NEAR(pose.tip_mm.y, 0, 1e-9);
            }
            run += path_length_mm(move);
        }
        EXPECT_NEAR(run, 30, 1e-9);
    }
}

TEST(GcodeRotary, SwitchingTipControlMovesNothing) {
    const motion::Program program = on("xyzac-trt",
                                       "G21 G90 G0 X10 Y20 Z50\nA30 C40\nM428\nG91 G1 X1 F100\nM429\n"
                                       "Z-5\nG43.4 H1\nY2\nG49\nX3\n",
                                       {1, 2, 13});
    expect_joined(program);
    // In the part's frame M428's X1 goes along the part's x, M429's Z-5 against the tool.
    const auto feed = [&](std::size_t from_end) { return program.moves[program.moves.size() - from_end]; };
    expect_near(feed(4).end.tip_mm - feed(4).start.tip_mm, {1, 0, 0}, 1e-9);
    expect_near(feed(3).end.tip_mm - feed(3).start.tip_mm, -5 * feed(3).start.axis, 1e-9);
    expect_near(feed(2).end.tip_mm - feed(2).start.tip_mm, {0, 2, 0}, 1e-9);
    expect_near(feed(1).end.tip_mm - feed(1).start.tip_mm, unturned({3, 0, 0}, 30 * kDeg, 40 * kDeg), 1e-9);
    expect_near(feed(4).start.tip_mm, unturned({11, 22, 63}, 30 * kDeg, 40 * kDeg) - Vec3{1, 2, 13}, 1e-9);
}

TEST(GcodeRotary, CountsInverseTimeAndDegreesForTheJoints) {
    // 60 / 20 = 3 s for any block, wherever the tip goes.
    const std::string_view inverse = "G21 G0 X40 Y0 Z0\nG93 G1 C90 F20\nX20 C180 F20\nX30 F20\n";
    EXPECT_NEAR(seconds(on("xyzac-trt", inverse)), 9, 1e-9);
    // On the spot F counts degrees: 90 at 180 a minute; with X along, the 20 mm of X.
    EXPECT_NEAR(seconds(on("xyzac-trt", "G21 G0 X40 Y0 Z0\nG94 G1 C90 F180\n")), 30, 1e-9);
    EXPECT_NEAR(seconds(on("xyzac-trt", "G21 G0 X40 Y0 Z0\nG94 G1 C90 X20 F180\n")), 20 / 3.0, 1e-9);
    // With the tip held by tip control too.
    EXPECT_NEAR(seconds(on("xyzac-trt", "G21 G0 X40 Y0 Z0\nM428\nG1 A-45 F90\n")), 30, 1e-9);
    // The quarter circle that the tip runs on the part.
    EXPECT_NEAR(feed_mm(on("xyzac-trt", "G21 G0 X40 Y0 Z0\nG1 C90 F180\n")), 20 * std::numbers::pi, 1e-4);
}

TEST(GcodeRotary, KeepsAnglesInDegreesWhateverTheUnit) {
    const motion::Program program = on("xyzab-tdr", "G20 G0 X1 Y0 Z1\nG91 A45\nA45\n");
    // ISO: A names the tool's turn against the part about +x, so A90 lays it along -y.
    expect_near(program.moves.back().end.axis, {0, -1, 0}, 1e-12);
    expect_near(program.moves.back().end.tip_mm, {25.4, -25.4, 0}, 1e-9);
}

TEST(GcodeRotary, CountsRotaryWordsFromTheWorkSystemsZero) {
    const motion::Program program =
        on("xyzac-trt", "G21 G10 L2 P2 X5 C30\nG55 G0 X0 Y0 Z0\nC10\nG53 C10\nG54 C0\n");
    const auto c_of = [&](std::size_t move) {
        const Vec3 tip = program.moves[move].end.tip_mm;
        return -std::atan2(tip.y, tip.x) / kDeg;
    };
    ASSERT_GE(program.moves.size(), 3u);
    double c = 0;
    for (std::size_t i = 0; i < program.moves.size(); ++i) c = std::max(c, c_of(i));
    EXPECT_NEAR(c, 40, 1e-4);
    EXPECT_NEAR(c_of(program.moves.size() - 1), 0, 1e-9);
}

TEST(GcodeRotary, TakesVectorsOfTheToolForTheJointsThatReachThem) {
    const motion::Program program = on("xyzac-trt",
                                       "G21 G0 X0 Y0 Z50\nG43.5 H1\nG1 X1 I0 J0.5 K0.8660254 F100\n"
                                       "X2 I0.5 J0 K0.8660254\nX3 I0 J0 K2\nX4\n");
    expect_joined(program);
    for (const motion::Move& move : program.moves) {
        if (std::abs(move.end.tip_mm.x - 1) < 1e-9) expect_near(move.end.axis, {0, 0.5, 0.8660254}, 1e-6);
        if (std::abs(move.end.tip_mm.x - 2) < 1e-9) expect_near(move.end.axis, {0.5, 0, 0.8660254}, 1e-6);
    }
    expect_near(program.moves.back().end.axis, {0, 0, 1}, 1e-9);
    EXPECT_NEAR(feed_mm(program), 4, 1e-9);
}

// A program in turned, mirrored or tilted coordinates is the one that was turned by hand.
TEST(GcodeRotary, TurnsVectorsOfTheToolWithTheirPoints) {
    const std::string written = "G0 X0 Y0 Z50\nG1 X10 Y0 Z0 I0.6 J0 K0.8 F100\nX20 Y5 I0 J-0.6 K0.8\nY9\n";
    const std::pair<const char*, const char*> frames[] = {
        {"G68 X0 Y0 R90\n", "G0 X0 Y0 Z50\nG1 X0 Y10 Z0 I0 J0.6 K0.8 F100\nX-5 Y20 I0.6 J0 K0.8\nX-9\n"},
        {"G51.1 X0\n", "G0 X0 Y0 Z50\nG1 X-10 Y0 Z0 I-0.6 J0 K0.8 F100\nX-20 Y5 I0 J-0.6 K0.8\nY9\n"},
        // Mirrored, the rotation turns the other way.
        {"G51.1 X0\nG68 X0 Y0 R90\n",
         "G0 X0 Y0 Z50\nG1 X0 Y10 Z0 I0 J0.6 K0.8 F100\nX5 Y20 I-0.6 J0 K0.8\nX9\n"},
        // A scale moves the points and leaves the axis.
        {"G51 X0 Y0 Z0 I2 J1 K1\n",
         "G0 X0 Y0 Z50\nG1 X20 Y0 Z0 I0.6 J0 K0.8 F100\nX40 Y5 I0 J-0.6 K0.8\nY9\n"},
        {"G68.2 X0 Y0 Z0 I90 J0 K0\n",
         "G0 X0 Y0 Z50\nG1 X0 Y10 Z0 I0 J0.6 K0.8 F100\nX-5 Y20 I0.6 J0 K0.8\nX-9\n"},
        // The system is turned, from the zero of the stock.
        {"G10 L2 P1 X0 Y0 R90\n",
         "G0 X0 Y0 Z50\nG1 X0 Y10 Z0 I0 J0.6 K0.8 F100\nX-5 Y20 I0.6 J0 K0.8\nX-9\n"},
    };
    const auto expect_same = [](const motion::Program& found, const motion::Program& by_hand,
                                const char* frame) {
        expect_joined(found);
        ASSERT_EQ(found.moves.size(), by_hand.moves.size()) << frame;
        for (std::size_t n = 0; n < found.moves.size(); ++n) {
            expect_near(found.moves[n].end.tip_mm, by_hand.moves[n].end.tip_mm, 1e-9);
            expect_near(found.moves[n].end.axis, by_hand.moves[n].end.axis, 1e-9);
        }
    };
    const std::string begin = "G21 G90 M3\nG0 X0 Y0 Z60\nG43.5 H1\n";
    for (const auto& [frame, by_hand] : frames) {
        SCOPED_TRACE(frame);
        expect_same(program_of(begin + "G1\n" + frame + written), program_of(begin + by_hand), frame);
        // The table of the machine stands turned by 90 degrees where the axes do: its moves are others.
        const motion::Program found = on("xyzac-trt", begin + frame + written);
        expect_joined(found);
        const motion::ToolPose end = program_of(begin + by_hand).moves.back().end;
        expect_near(found.moves.back().end.tip_mm, end.tip_mm, 1e-9);
        expect_near(found.moves.back().end.axis, end.axis, 1e-9);
    }
}

TEST(GcodeRotary, ReportsTravelAndSingularPositionsWithTheirLines) {
    motion::Machine machine = *motion::named_machine("xyzac-trt");
    machine.part_side[0].min = -30 * kDeg;
    machine.tool_side[0].max = 100;
    GcodeOptions options;
    options.machine = &machine;
    const motion::Program program = program_of(
        "G21 G0 X0 Y0 Z0\nM428\nG0 A-31\nG1 X90 F100\nX101\nX105\nX50 A-40\nA-0.1\nX60 C175\n", options);
    EXPECT_TRUE(warns_of(program, 3, "A travels beyond its limit of -30 deg, as far as -40 deg on line 7"));
    EXPECT_TRUE(warns_of(program, 5, "X travels beyond its limit of 100 mm, as far as 105 mm on line 6"));
    EXPECT_TRUE(warns_of(program, 9, "near a singular position"));
}

TEST(GcodeRotary, ReadsTheSameRealProgramWithAndWithoutItsMachine) {
    const auto bytes = real_file("lcnc-5x-boat-xyzac.ngc");
    if (!bytes) GTEST_SKIP() << "no ../shared/data/gcode";
    const motion::Program plain = program_of(*bytes), table = on("xyzac-trt", *bytes);
    EXPECT_EQ(plain.moves.size(), 1810u);
    // With tool tip control (M428) the tip runs where the words lead it, however the table turns.
    EXPECT_NEAR(feed_mm(table), 3552.566077, 1e-4);
}

TEST(GcodeRotary, RefusesWhatTheMachineCannotDo) {
    EXPECT_EQ(fault("xyzac-trt", "G21 G0 X0 Y0 Z0\nG1 B10 F100\n"),
              "p.nc:2:4: error: the machine xyzac-trt has no axis B; name the machine that the program is "
              "written for");
    EXPECT_EQ(fault("xyza", "G21 G0 X0 Y0 Z0\nG43.5 H1\nG1 X1 I1 J0 K1 F100\n"),
              "p.nc:3:7: error: the machine xyza cannot turn its tool there; name the machine that the "
              "program is written for");
    EXPECT_EQ(fault("xyzac-trt", "G21 G0 X0 Y0 Z0\nG43.5 H1\nG1 X1 I0 J0 K0 F100\n"),
              "p.nc:3:7: error: the tool's axis I J K has no direction; write the direction from the tip to "
              "the shank");
    EXPECT_EQ(fault("head-head", "G21 G0 X0 Y0 Z0\nB30\n"),
              "p.nc:2:1: error: where the tilted head of the machine head-head brings the tip depends on the "
              "tool's length; add tool_length_mm, from the spindle nose to the tip, to the machine");
    EXPECT_EQ(
        fault("xyzac-trt", "G21 G0 X0 Y0 Z0 C1000000\n"),
        "p.nc:1:17: error: C: the angle of a rotary axis of 1000000 deg is out of range; keep the angle "
        "of a rotary axis within -100000 to 100000 deg");
    EXPECT_EQ(
        fault("xyzac-trt", "G21 G0 X0 Y0 Z0\nM430\n"),
        "p.nc:2:1: error: M430 switches to kinematics that only its own machine knows; use M428 for tool "
        "tip control, M429 for none");
}

TEST(GcodeRotary, GivesRotaryAxesNewAnglesWhereTheyStand) {
    const std::string begin = "G21 F100\nG0 X10 Y0 Z0 C90\n";
    const motion::Program plain = on("xyzac-trt", begin + "G1 X20 C120\n");
    const motion::Program preset = on("xyzac-trt", begin + "G92 C0\nG1 X20 C30\n");
    ASSERT_FALSE(plain.moves.empty());
    expect_near(preset.moves.back().end.tip_mm, plain.moves.back().end.tip_mm);
    EXPECT_NEAR(feed_mm(preset), feed_mm(plain), 1e-9);
}

TEST(GcodeRotary, RefusesATurnThatBecomesMoreMovesThanFit) {
    const std::string far = "G21 F100\nG0 X0 Y13000 Z0\nG1 X10 A30 C90600\n";
    const std::string said = fault("xyzac-trt", far);
    EXPECT_TRUE(said.starts_with("p.nc:3:")) << said;
    EXPECT_NE(said.find("more moves than fit"), std::string::npos) << said;
    EXPECT_NE(said.find("split it"), std::string::npos) << said;
    EXPECT_GT(on("xyzac-trt", "G21 F100\nG0 X0 Y500 Z0\nG1 X10 A30 C90600\n").moves.size(), 50'000u);
}

TEST(GcodeRotary, NeedsNoToolLengthForATippedHeadUnderTipControl) {
    const motion::Program program =
        on("head-head", "G21 G43.4 H1 G0 X0 Y0 Z0\nB30 C90\nG1 X10 F100\nB0\nG49\nX0\n");
    expect_joined(program);
    EXPECT_NEAR(feed_mm(program), 20, 1e-9);
}

}  // namespace
}  // namespace tribo::readers
