// SPDX-License-Identifier: MIT
// Tilted planes: G68.2, G68.3, G68 about an axis in space, G268, G53.1. Places in closed form.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "readers/gcode/gcode_text.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

const double kC = std::cos(kPi / 6), kS = std::sin(kPi / 6);

motion::Program tilted(const std::string& text, const motion::Machine* machine = nullptr) {
    GcodeOptions options;
    options.dialect = GcodeDialect::fanuc;
    options.machine = machine;
    return program_of("G21 G90 G54 M3 S1000 F100\n" + text, options);
}

motion::ToolPose end_of(const motion::Program& program) {
    return program.moves.empty() ? motion::ToolPose{} : program.moves.back().end;
}

void expect_pose(const motion::ToolPose& pose, Vec3 tip, Vec3 axis) {
    EXPECT_LT(distance(pose.tip_mm, tip), 1e-9)
        << pose.tip_mm.x << ' ' << pose.tip_mm.y << ' ' << pose.tip_mm.z;
    EXPECT_LT(distance(pose.axis, axis), 1e-12);
}

TEST(GcodeTiltedPlane, eulers_angles_turn_about_z_x_and_z) {
    const motion::Program program = tilted("G68.2 X1 Y2 Z3 I90 J30 K-90\nG53.1\nG0 X0 Y0 Z5\nG1 X10\n");
    expect_pose(end_of(program), {1 + 10 * kC + 5 * kS, 2, 3 + 5 * kC - 10 * kS}, {kS, 0, kC});
}

TEST(GcodeTiltedPlane, arcs_and_cycles_lie_in_the_plane) {
    const motion::Program arc = tilted("G68.2 X0 Y0 Z0 I0 J90 K0\nG53.1\nG0 X0 Y0 Z0\nG3 X10 Y10 I0 J10\n");
    // X stays, Y is the stock's Z, and the tool points along -Y.
    expect_pose(end_of(arc), {10, 0, 10}, {0, -1, 0});
    ASSERT_TRUE(arc.moves.back().arc.has_value());
    EXPECT_LT(distance(arc.moves.back().arc->centre_mm, {0, 0, 10}), 1e-12);
    const motion::Program drilled =
        tilted("G68.2 X0 Y0 Z0 I0 J90 K0\nG53.1\nG0 X0 Y0 Z9\nG99 G81 X3 Y4 Z-5 R1\n");
    expect_pose(end_of(drilled), {3, -1, 4}, {0, -1, 0});
    EXPECT_NEAR(feed_mm(drilled), 6, 1e-9);
}

TEST(GcodeTiltedPlane, roll_pitch_and_yaw_turn_about_the_fixed_axes_in_order) {
    // First 90 degrees about X, then 90 about Z: the tool points from +z over -y to +x.
    const motion::Program program =
        tilted("G68.2 P1 Q123 X0 Y0 Z0 I90 K90\nG53.1\nG0 X0 Y0 Z0\nG1 X2 Y3 Z4\n");
    expect_pose(end_of(program), {4, 2, 3}, {1, 0, 0});
    EXPECT_TRUE(warns_of(program, 2, "about the fixed axes"));
    // First about Z, then about X.
    expect_pose(end_of(tilted("G268 X0 Y0 Z0 I90 K90 Q321\nG53.1\nG0 X0 Y0 Z0\nG1 X2 Y3 Z4\n")), {-3, -4, 2},
                {0, -1, 0});
}

TEST(GcodeTiltedPlane, points_vectors_and_projections_state_the_same_plane) {
    // Z as in eulers_angles_turn_about_z_x_and_z; X along (cos 30, 0, -sin 30), Y as the stock's.
    const std::string c = std::to_string(kC), s = std::to_string(kS);
    const std::string rest = "\nG53.1\nG0 X0 Y0 Z5\nG1 X10\n";
    const Vec3 tip{1 + 10 * kC + 5 * kS, 2, 3 + 5 * kC - 10 * kS}, axis{kS, 0, kC};
    const std::string by_points = "G68.2 P2 Q1 X1 Y2 Z3\nG68.2 P2 Q2 X" + std::to_string(1 + 20 * kC) +
                                  " Y2 Z" + std::to_string(3 - 20 * kS) + "\nG68.2 P2 Q3 X1 Y7 Z3";
    const std::string by_vectors =
        "G68.2 P3 Q1 X1 Y2 Z3 I" + c + " J0 K-" + s + "\nG68.2 P3 Q2 I" + s + " J0 K" + c;
    for (const std::string& plane :
         {"G68.2 P2 Q0 X0 Y0 Z0 R0\n" + by_points, by_points, by_vectors,
          // Written in another order, and anew over a plane before.
          "G68.2 P2 Q3 X1 Y7 Z3\nG68.2 P2 Q1 X1 Y2 Z3\nG68.2 P2 Q2 X" + std::to_string(1 + 20 * kC) +
              " Y2 Z" + std::to_string(3 - 20 * kS),
          "G68.2 X0 Y0 Z0 I0 J90 K0\n" + by_vectors, "G68.2 P4 X1 Y2 Z3 I30 J0 K0" + std::string()}) {
        const motion::ToolPose pose = end_of(tilted(plane + rest));
        EXPECT_LT(distance(pose.tip_mm, tip), 1e-5) << plane;
        EXPECT_LT(distance(pose.axis, axis), 1e-6) << plane;
    }
    // Both projections: the tool is normal to (cos I, 0, -sin I) and (0, cos J, sin J).
    const motion::ToolPose both =
        end_of(tilted("G68.2 P4 X0 Y0 Z0 I30 J20 K90\nG53.1\nG0 X0 Y0 Z0\nG1 Y-1\n"));
    EXPECT_NEAR(dot(both.axis, {kC, 0, -kS}), 0, 1e-12);
    EXPECT_NEAR(dot(both.axis, {0, std::cos(kPi / 9), std::sin(kPi / 9)}), 0, 1e-12);
    expect_pose(both, {kC, 0, -kS}, both.axis);  // turned by 90 degrees, -y lies along the first vector
}

TEST(GcodeTiltedPlane, g68_in_space_turns_about_its_axis_and_adds_to_one_before) {
    expect_pose(end_of(tilted("G68 X1 Y0 Z0 I1 J0 K0 R90\nG0 X0 Y0 Z0\nG1 X2 Y3 Z4\n")), {3, -4, 3},
                {0, -1, 0});
    expect_pose(
        end_of(tilted("G68 X0 Y0 Z0 I1 J0 K0 R90\nG68 X0 Y0 Z0 I0 J0 K1 R90\nG0 X0 Y0 Z0\nG1 X2 Y3 Z4\n")),
        {-3, -4, 2}, {0, -1, 0});
}

TEST(GcodeTiltedPlane, the_tool_stays_until_g53_1_and_its_place_is_not_known_then) {
    const motion::Program program =
        tilted("G0 X0 Y0 Z50\nG68.2 X0 Y0 Z0 I0 J90 K0\nG53.1\nG1 X10\nG0 X0 Y0 Z50\nG1 Z0\n");
    EXPECT_TRUE(warns_of(program, 5, "this move starts at a place that only the machine knows"));
    EXPECT_NEAR(feed_mm(program), 50, 1e-9);
    // G53.6 keeps the tip; a plane that is not tilted keeps everything.
    EXPECT_NEAR(feed_mm(tilted("G0 X0 Y0 Z50\nG68.2 X0 Y0 Z0 I0 J90 K0\nG53.6\nG1 X10\n")), 10, 1e-9);
    const motion::Program level =
        tilted("G0 X0 Y0 Z50\nG68.2 X5 Y0 Z0 I30 J0 K0\nG53.1\nG1 X10 Y0\nG69\nX0 Y0\n");
    expect_pose(end_of(level), {0, 0, 50}, {0, 0, 1});
    EXPECT_NEAR(feed_mm(level), std::hypot(5 + 10 * kC, 10 * kS) * 2, 1e-9);
}

TEST(GcodeTiltedPlane, the_machine_turns_to_the_plane_and_back) {
    const motion::Machine machine = *motion::named_machine("xyzac-trt");
    const motion::Program program = tilted(
        "G0 X0 Y0 Z50\nG68.2 X1 Y2 Z3 I90 J30 K-90\nG53.1\nG0 X0 Y0 Z5\nG1 X10\nG69\nG0 A0 C0\nX0 Y0 Z5\n"
        "G1 Z1\n",
        &machine);
    const auto leaning =
        std::find_if(program.moves.begin(), program.moves.end(),
                     [](const motion::Move& move) { return move.kind == motion::MoveKind::feed; });
    ASSERT_NE(leaning, program.moves.end());
    EXPECT_LT(distance(leaning->end.tip_mm, {1 + 10 * kC + 5 * kS, 2, 3 + 5 * kC - 10 * kS}), 1e-6);
    EXPECT_LT(distance(leaning->end.axis, {kS, 0, kC}), 1e-9);
    expect_pose(end_of(program), {0, 0, 1}, {0, 0, 1});
}

RC_GTEST_PROP(GcodeTiltedPlane, distances_and_the_tools_angle_to_the_plane_stay, ()) {
    const auto degrees = [] { return *rc::gen::inRange(-3600, 3601) / 10.0; };
    const auto mm = [] { return *rc::gen::inRange(-10'000, 10'001) / 10.0; };
    const std::string head = "G68.2 X" + short_decimal(mm()) + " Y" + short_decimal(mm()) + " Z" +
                             short_decimal(mm()) + " I" + short_decimal(degrees()) + " J" +
                             short_decimal(degrees()) + " K" + short_decimal(degrees()) + "\nG53.1\n";
    const Vec3 by{mm(), mm(), mm()};
    const motion::Program program = tilted(head + "G0 X0 Y0 Z0\nG1 X" + short_decimal(by.x) + " Y" +
                                           short_decimal(by.y) + " Z" + short_decimal(by.z) + "\n");
    if (by == Vec3{}) return;
    const motion::Move& move = program.moves.back();
    const Vec3 way = move.end.tip_mm - move.start.tip_mm;
    RC_ASSERT(std::abs(length(way) - length(by)) < 1e-8);
    RC_ASSERT(std::abs(dot(way, move.end.axis) - by.z) < 1e-8);
}

TEST(GcodePatterns, drill_on_circles_arcs_and_lines) {
    const auto holes = [](const std::string& text) {
        std::vector<Vec3> found;
        const std::string start = "G99 G81 Z-1 R1 F100 L0\n";
        for (const motion::Move& move : tilted("G0 X10 Y20 Z5\n" + start + text).moves) {
            if (move.kind == motion::MoveKind::feed) found.push_back(move.end.tip_mm);
        }
        return found;
    };
    const auto circle = holes("G70 I4 J90 L4\n");
    ASSERT_EQ(circle.size(), 4U);
    EXPECT_LT(distance(circle[0], {10, 24, -1}), 1e-9);
    EXPECT_LT(distance(circle[1], {6, 20, -1}), 1e-9);
    const auto arc = holes("G71 X0 Y0 I2 J0 K30 L3\n");
    ASSERT_EQ(arc.size(), 3U);
    EXPECT_LT(distance(arc[2], {1, std::sqrt(3.0), -1}), 1e-9);
    const auto line = holes("G72 X0 Y0 I2 J90 L3\n");
    ASSERT_EQ(line.size(), 3U);
    EXPECT_LT(distance(line[0], {0, 0, -1}), 1e-9);
    EXPECT_LT(distance(line[2], {0, 4, -1}), 1e-9);
}

TEST(GcodeLenient, an_arc_without_centre_is_a_line_on_fanuc_controls_alone) {
    const motion::Program program = tilted("G0 X0 Y0 Z0\nG2 X3 Y4\nX6 Y8 R5\n");
    EXPECT_TRUE(warns_of(program, 3, "a straight line on Fanuc controls"));
    EXPECT_FALSE(program.moves.at(0).arc.has_value());
    EXPECT_TRUE(program.moves.at(1).arc.has_value());
    EXPECT_FALSE(read_gcode("G21 M3 F9\nG0 X0 Y0 Z0\nG2 X3 Y4\n").has_value());
}

}  // namespace
}  // namespace tribo::readers
