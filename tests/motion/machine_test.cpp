// SPDX-License-Identifier: MIT
#include "motion/machine/machine.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "motion/algebra/direction.hpp"
#include "motion/machine/kinematics.hpp"
#include "motion/machine/machine_path.hpp"
#include "motion/path/path.hpp"

using namespace tribo;
using namespace tribo::motion;

namespace {

constexpr double kDeg = std::numbers::pi / 180;

Machine named(const char* name) {
    return *named_machine(name);
}

// The closed forms of LinuxCNC's kinematics (forward, tool length 0), written out as its documentation has
// them: joints to the tip in the table's frame.
Vec3 xyzac_tip(Vec3 j, double a, double c, double dy, double dz) {
    const double y = j.y - dy, z = j.z - dz;
    return {
        std::cos(c) * j.x + std::sin(c) * std::cos(a) * y + std::sin(c) * std::sin(a) * z + std::sin(c) * dy,
        -std::sin(c) * j.x + std::cos(c) * std::cos(a) * y + std::cos(c) * std::sin(a) * z + std::cos(c) * dy,
        -std::sin(a) * y + std::cos(a) * z + dz};
}
Vec3 xyzbc_tip(Vec3 j, double b, double c, double dx, double dz) {
    const double x = j.x - dx, z = j.z - dz;
    return {
        std::cos(c) * std::cos(b) * x + std::sin(c) * j.y - std::cos(c) * std::sin(b) * z + std::cos(c) * dx,
        -std::sin(c) * std::cos(b) * x + std::cos(c) * j.y + std::sin(c) * std::sin(b) * z - std::sin(c) * dx,
        std::sin(b) * x + std::cos(b) * z + dz};
}
Vec3 xyzab_tip(Vec3 j, double a, double b, double dz) {
    return {std::cos(b) * j.x + std::sin(b) * j.z,
            std::sin(a) * std::sin(b) * j.x + std::cos(a) * j.y - std::cos(b) * std::sin(a) * j.z +
                std::sin(a) * dz,
            -std::cos(a) * std::sin(b) * j.x + std::sin(a) * j.y + std::cos(a) * std::cos(b) * j.z -
                std::cos(a) * dz + dz};
}

// The axis is where a second tip, one higher on the tool, stands above the first.
template <class Tip>
void expect_pose(const ToolPose& pose, const Tip& tip_of, Vec3 joints) {
    const Vec3 tip = tip_of(joints), above = tip_of(joints + Vec3{0, 0, 1});
    EXPECT_LT(distance(pose.tip_mm, tip), 1e-9);
    EXPECT_LT(distance(pose.axis, above - tip), 1e-12);
}

double uniform(double low, double high) {
    return low + (high - low) * (*rc::gen::inRange(0, 1'000'001)) / 1e6;
}
Vec3 any_point(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
}
Vec3 any_angles() {
    return {uniform(-3, 3), uniform(-3, 3), uniform(-6, 6)};
}

// A machine with nothing special about it: all axes skew, on both sides, linear ones among them.
Machine skew_machine() {
    Machine m;
    m.name = "skew";
    m.part_side.push_back({.word = 'X', .direction = normalized(Vec3{-1, 0.1, 0.2})});
    m.part_side.push_back(
        {.word = 'C', .direction = normalized(Vec3{0.2, -0.3, -1}), .pivot_mm = {10, 20, -30}, .zero = 0.3});
    m.tool_side.push_back({.word = 'B', .direction = normalized(Vec3{0.1, 1, 0.6}), .pivot_mm = {5, 0, 70}});
    m.tool_side.push_back({.word = 'Z', .direction = normalized(Vec3{0.1, 0.2, 1})});
    m.stock_mm = {3, -4, 5};
    add_linear_axes(m);
    return m;
}

RC_GTEST_PROP(Kinematics, are_those_of_linuxcnc_for_the_machines_of_its_names, ()) {
    const Vec3 joints = any_point(200);
    const double first = uniform(-3, 3), second = uniform(-6, 6), d = uniform(-50, 50), dz = uniform(-50, 50);

    Machine ac = named("xyzac-trt");
    ac.part_side[0].pivot_mm = {0, d, dz};
    expect_pose(
        Kinematics(ac).pose({joints, {first, 0, second}}),
        [&](Vec3 j) { return xyzac_tip(j, first, second, d, dz); }, joints);

    Machine bc = named("xyzbc-trt");
    bc.part_side[0].pivot_mm = {d, 0, dz};
    expect_pose(
        Kinematics(bc).pose({joints, {0, first, second}}),
        [&](Vec3 j) { return xyzbc_tip(j, first, second, d, dz); }, joints);

    Machine ab = named("xyzab-tdr");
    ab.part_side[1].pivot_mm = {0, 0, dz};
    expect_pose(
        Kinematics(ab).pose({joints, {first, second, 0}}),
        [&](Vec3 j) { return xyzab_tip(j, first, second, dz); }, joints);
}

TEST(Kinematics, of_a_head_swing_the_tip_about_the_pivot_by_pivot_and_tool_length) {
    Machine machine = named("head-head");
    for (MachineAxis& axis : machine.tool_side) {
        if (axis.turns()) axis.pivot_mm = {0, 0, 150};
    }
    const Kinematics head(machine, 100);
    // B90 lays the tool along +x: the tip is 250 mm on the far side of the pivot, which stands 250 mm high.
    const ToolPose side = head.pose({{1, 2, 3}, {0, 90 * kDeg, 0}});
    EXPECT_LT(distance(side.axis, {1, 0, 0}), 1e-12);
    EXPECT_LT(distance(side.tip_mm, {1 - 250, 2, 3 + 250}), 1e-9);
    // C90 turns that to +y.
    const ToolPose turned = head.pose({{1, 2, 3}, {0, 90 * kDeg, 90 * kDeg}});
    EXPECT_LT(distance(turned.axis, {0, 1, 0}), 1e-12);
    EXPECT_LT(distance(turned.tip_mm, {1, 2 - 250, 3 + 250}), 1e-9);
}

TEST(Kinematics, of_a_head_with_a_table_turn_both) {
    const Kinematics machine(named("head-table"));
    // B tilts the tool to (sin B, 0, cos B) in the room; the words name the tool's turn against the part, so
    // C turns it right-handed about +z as the part sees it.
    const ToolPose pose = machine.pose({{50, 0, 0}, {0, 30 * kDeg, 90 * kDeg}});
    EXPECT_LT(distance(pose.axis, {0, 0.5, std::sqrt(0.75)}), 1e-12);
    EXPECT_LT(distance(pose.tip_mm, {0, 50, 0}), 1e-9);
}

TEST(Kinematics, count_the_stock_from_its_place_on_the_machine) {
    Machine machine = named("xyzac-trt");
    machine.stock_mm = {0, 0, 40};
    // The part's zero stands 40 mm above the tilting axis: A90 brings it to y = -40 on the machine.
    const Kinematics table(machine);
    EXPECT_LT(distance(table.pose({{0, -40, 0}, {90 * kDeg, 0, 0}}).tip_mm, {0, 0, 0}), 1e-9);
    const Joints back = table.with_tip({0, 0, 0}, {90 * kDeg, 0, 0});
    EXPECT_LT(distance(back.linear_mm, {0, -40, 0}), 1e-9);
}

RC_GTEST_PROP(Kinematics, bring_every_pose_that_joints_give_back_to_that_pose, ()) {
    const Machine machines[] = {named("xyzac-trt"), named("xyzbc-trt"),  named("xyzab-tdr"),
                                named("head-head"), named("head-table"), skew_machine()};
    for (const Machine& machine : machines) {
        const Kinematics kinematics(machine, 80);
        const Joints from{any_point(300), any_angles()}, near{{}, any_angles()};
        const ToolPose pose = kinematics.pose(from);
        const auto reached = kinematics.joints(pose, near);
        RC_ASSERT(reached.has_value());
        RC_ASSERT(reached->within_limits);
        const ToolPose again = kinematics.pose(reached->joints);
        RC_ASSERT(distance(again.tip_mm, pose.tip_mm) < 1e-6);
        RC_ASSERT(distance(again.axis, pose.axis) < 2e-6);
        // Asked near the joints it came from it finds those, up to the tool along the outer axis.
        const auto same = kinematics.joints(pose, from);
        if (!same->singular) RC_ASSERT(distance(same->joints.rotary_rad, from.rotary_rad) < 1e-4);
    }
}

TEST(Kinematics, choose_the_branch_that_goes_on_through_the_upright_tool) {
    const Kinematics table(named("xyzac-trt"));
    // A swings from -20 to 20 degrees at C 35: the axis passes upright, where C means nothing.
    Joints at{{}, {-20 * kDeg, 0, 35 * kDeg}};
    for (int a = -19; a <= 20; ++a) {
        const auto reached = table.joints(table.pose({{}, {a * kDeg, 0, 35 * kDeg}}), at);
        ASSERT_TRUE(reached);
        EXPECT_EQ(reached->singular, a == 0);
        at = reached->joints;
        EXPECT_NEAR(at.rotary_rad.x, a * kDeg, 1e-9);
        EXPECT_NEAR(at.rotary_rad.z, 35 * kDeg, 1e-9);
    }
}

TEST(Kinematics, take_the_other_branch_where_the_near_one_is_beyond_the_limits) {
    Machine machine = named("xyzac-trt");
    machine.part_side[0].min = -100 * kDeg;
    machine.part_side[0].max = 10 * kDeg;
    const Kinematics table(machine);
    const auto reached = table.joints(table.pose({{}, {60 * kDeg, 0, 0}}), {});
    ASSERT_TRUE(reached);
    EXPECT_TRUE(reached->within_limits);
    EXPECT_NEAR(reached->joints.rotary_rad.x, -60 * kDeg, 1e-9);
    EXPECT_NEAR(std::abs(reached->joints.rotary_rad.z), 180 * kDeg, 1e-9);
}

TEST(Kinematics, wind_on_within_the_limits_and_back_at_their_end) {
    Machine machine = named("xyzac-trt");
    machine.part_side[0].min = 0;  // the other branch stays shut
    machine.part_side[1].min = -200 * kDeg;
    machine.part_side[1].max = 400 * kDeg;
    const Kinematics table(machine);
    const auto c_near = [&](double c_deg, double near_deg) {
        const Joints near{{}, {0.5, 0, near_deg * kDeg}};
        return table.joints(table.pose({{}, {0.5, 0, c_deg * kDeg}}), near)->joints.rotary_rad.z / kDeg;
    };
    EXPECT_NEAR(c_near(10, 350), 370, 1e-9);
    EXPECT_NEAR(c_near(60, 390), 60, 1e-9);  // 420 is beyond
    EXPECT_NEAR(c_near(-170, 395), 190, 1e-9);
}

TEST(Kinematics, say_that_an_axis_cannot_be_reached) {
    const Kinematics indexer(named("xyza"));
    EXPECT_TRUE(indexer.joints({{}, {0, 0.6, 0.8}}, {}));
    EXPECT_FALSE(indexer.joints({{}, {0.6, 0, 0.8}}, {}));
    // A swivel head at 45 degrees reaches the half space above, no more.
    Machine swivel = named("head-head");
    swivel.tool_side.back().direction = normalized(Vec3{0, 1, 1});
    const Kinematics head(swivel);
    EXPECT_TRUE(head.joints({{}, {1, 0, 0}}, {}));
    EXPECT_FALSE(head.joints({{}, normalized(Vec3{1, 0, -0.01})}, {}));
}

TEST(Kinematics, name_the_axes_that_travel_too_far) {
    Machine machine = named("xyzac-trt");
    machine.tool_side[1].max = 100;
    machine.part_side[0].min = -10 * kDeg;
    const Kinematics table(machine);
    std::array<Overtravel, 6> found;
    EXPECT_EQ(table.overtravel({{1000, 100, 0}, {-10 * kDeg, 0, 0}}, found), 0);
    ASSERT_EQ(table.overtravel({{0, 101, 0}, {}}, found), 1);
    EXPECT_EQ(found[0].word, 'Y');
    EXPECT_EQ(found[0].limit, 100);
    ASSERT_EQ(table.overtravel({{0, 101, 0}, {-11 * kDeg, 0, 0}}, found), 2);
    EXPECT_EQ(found[0].word, 'A');
    EXPECT_EQ(found[1].word, 'Y');
}

TEST(Machine, refuses_chains_that_cannot_be) {
    const auto cause = [](const auto& change) {
        Machine machine = named("xyzac-trt");
        change(machine);
        const Result<void> good = check(machine);
        EXPECT_FALSE(good.has_value());
        if (good) return std::string();
        EXPECT_FALSE(good.error().remedy.empty());
        return good.error().cause;
    };
    EXPECT_EQ(cause([](Machine& m) { m.part_side[1].word = 'A'; }), "the machine has two axes A");
    EXPECT_EQ(cause([](Machine& m) { m.part_side[1].word = 'U'; }), "axis U has no meaning here");
    EXPECT_EQ(cause([](Machine& m) { m.part_side[0].direction = {0, 0, 2}; }),
              "the direction of axis A is not a unit vector");
    EXPECT_EQ(cause([](Machine& m) { m.tool_side[1].direction = {1, 0, 0}; }),
              "the linear axes lie in one plane");
    EXPECT_EQ(cause([](Machine& m) { m.tool_side.pop_back(); }), "the machine has no axis Z");
    EXPECT_EQ(cause([](Machine& m) { m.part_side[1].direction = {-1, 0, 0}; }),
              "both rotary axes have one direction");
    EXPECT_EQ(cause([](Machine& m) { std::swap(m.part_side[0], m.part_side[1]); }),
              "the rotary axis nearest to the tool turns about the spindle: it tilts nothing");
    EXPECT_EQ(cause([](Machine& m) { m.tool_side.push_back({.word = 'B', .direction = {0, 1, 0}}); }),
              "the machine has three rotary axes");
    EXPECT_EQ(cause([](Machine& m) { m.part_side[0].min = 1, m.part_side[0].max = 1; }),
              "the limits of axis A leave no travel");
}

TEST(Machine, that_nobody_knows_is_named_with_those_that_are) {
    const auto machine = named_machine("xyzac-trd");
    ASSERT_FALSE(machine);
    EXPECT_NE(machine.error().remedy.find("xyzac-trt"), std::string::npos);
    for (const char* name : {"xyzac-trt", "xyzbc-trt", "xyzab-tdr", "head-head", "head-table", "xyza"})
        EXPECT_TRUE(check(named(name))) << name;
}

Move words(MoveKind kind, double feed, double duration) {
    Move move;
    move.kind = kind;
    move.feed_mm_per_min = feed;
    move.duration_s = duration;
    move.line = 7;
    return move;
}

// Largest distance between the pieces and the block they stand for, both run over equal parameters.
void expect_near(const std::vector<Move>& moves, const Kinematics& kinematics, const MachineBlock& block,
                 double duration_s) {
    double time = 0;
    for (const Move& move : moves) {
        for (int i = 0; i <= 20; ++i) {
            const double t = (time + i / 20.0 * move.duration_s) / duration_s;
            const ToolPose should = pose_at(kinematics, block, t), is = pose_at(move, i / 20.0);
            ASSERT_LT(distance(is.tip_mm, should.tip_mm), 1e-4);
            ASSERT_LT(angle_rad(is.axis, should.axis), 2.5e-6);
        }
        time += move.duration_s;
    }
    EXPECT_NEAR(time, duration_s, 1e-9 * duration_s);
}

RC_GTEST_PROP(MachineBlock, becomes_pieces_that_follow_the_joints_within_the_tolerance, ()) {
    const Kinematics kinematics(skew_machine(), 60);
    MachineBlock block;
    block.tip_control = *rc::gen::arbitrary<bool>();
    block.start_mm = any_point(50);
    block.end_mm = any_point(50);
    block.start_rad = {0, uniform(-1, 1), uniform(-4, 4)};
    block.end_rad = block.start_rad + Vec3{0, uniform(-1, 1), uniform(-7, 7)};
    std::vector<Move> moves;
    append_moves(kinematics, block, words(MoveKind::feed, 0, 12), {}, 100'000, moves);
    expect_near(moves, kinematics, block, 12);
    for (std::size_t i = 1; i < moves.size(); ++i) RC_ASSERT(moves[i].start == moves[i - 1].end);
    RC_ASSERT(moves.front().line == 7);
}

TEST(MachineBlock, at_rest_on_a_tilted_table_keeps_its_arcs_exact) {
    const Kinematics table(named("xyzac-trt"));
    MachineBlock block;
    block.start_mm = {10, 0, 5};
    block.end_mm = {0, 10, 5};
    block.arc = Arc{{0, 0, 5}, {0, 0, 1}, 90 * kDeg};
    block.start_rad = block.end_rad = {30 * kDeg, 0, 45 * kDeg};
    std::vector<Move> moves;
    append_moves(table, block, words(MoveKind::feed, 500, 0), {}, 100'000, moves);
    ASSERT_EQ(moves.size(), 1u);
    EXPECT_NEAR(path_length_mm(moves[0]), 10 * 90 * kDeg, 1e-9);
    for (const double t : {0.0, 0.25, 0.5, 1.0}) {
        const double p = t * 90 * kDeg;
        const Vec3 should = xyzac_tip({10 * std::cos(p), 10 * std::sin(p), 5}, 30 * kDeg, 45 * kDeg, 0, 0);
        EXPECT_LT(distance(pose_at(moves[0], t).tip_mm, should), 1e-9);
    }
}

TEST(MachineBlock, without_tip_control_leads_the_tip_round_the_table) {
    // Only C turns, by a quarter: the tip, at rest in the room, runs a quarter circle on the table.
    const Kinematics table(named("xyzac-trt"));
    MachineBlock block;
    block.start_mm = block.end_mm = {40, 0, 3};
    block.end_rad = {0, 0, 90 * kDeg};
    std::vector<Move> moves;
    append_moves(table, block, words(MoveKind::feed, 0, 6), {}, 100'000, moves);
    double length = 0, time = 0;
    for (const Move& move : moves) {
        length += path_length_mm(move);
        time += move.duration_s;
        EXPECT_NEAR(move.feed_mm_per_min, 40 * 90 * kDeg / 6 * 60, 0.01);
    }
    EXPECT_NEAR(length, 40 * 90 * kDeg, 1e-4);
    EXPECT_NEAR(time, 6, 1e-12);
    EXPECT_LT(distance(moves.back().end.tip_mm, {0, -40, 3}), 1e-9);
}

TEST(MachineBlock, with_tip_control_and_one_axis_square_to_the_tool_is_one_straight_move) {
    const Kinematics table(named("xyzac-trt"));
    MachineBlock block;
    block.tip_control = true;
    block.start_mm = {0, 0, 0};
    block.end_mm = {30, 0, 0};
    block.end_rad = {20 * kDeg, 0, 0};
    std::vector<Move> moves;
    append_moves(table, block, words(MoveKind::feed, 800, 0), {}, 100'000, moves);
    ASSERT_EQ(moves.size(), 1u);
    EXPECT_FALSE(moves[0].quadratic);
    EXPECT_EQ(moves[0].feed_mm_per_min, 800);
    EXPECT_LT(distance(moves[0].end.axis, {0, std::sin(20 * kDeg), std::cos(20 * kDeg)}), 1e-12);
}

}  // namespace
