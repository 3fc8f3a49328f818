// SPDX-License-Identifier: MIT
// The named machines against chains of homogeneous matrices that are multiplied here.
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "base/math.hpp"
#include "motion/machine/kinematics.hpp"
#include "motion/machine/machine.hpp"

namespace tribo::motion {
namespace {

using Matrix = std::array<std::array<double, 4>, 4>;

constexpr double kDeg = 3.14159265358979323846 / 180;
const double kHalf = std::sqrt(0.5);

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            for (std::size_t k = 0; k < 4; ++k) c[i][j] += a[i][k] * b[k][j];
        }
    }
    return c;
}

// The turn by an angle about a unit vector through the origin, after Rodrigues.
Matrix turn(Vec3 u, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), v = 1 - c;
    return {{{c + u.x * u.x * v, u.x * u.y * v - u.z * s, u.x * u.z * v + u.y * s, 0},
             {u.y * u.x * v + u.z * s, c + u.y * u.y * v, u.y * u.z * v - u.x * s, 0},
             {u.z * u.x * v - u.y * s, u.z * u.y * v + u.x * s, c + u.z * u.z * v, 0},
             {0, 0, 0, 1}}};
}
Matrix shift(Vec3 d) {
    return {{{1, 0, 0, d.x}, {0, 1, 0, d.y}, {0, 0, 1, d.z}, {0, 0, 0, 1}}};
}

struct Axis {
    char word;
    Vec3 direction;
};
struct Chain {
    const char* name;
    std::vector<Axis> part,
        tool;  // from the frame outwards; growing words turn right-handed about the direction
};

// As the machines stand in docs/machines.md.
const Chain kChains[] = {
    {"table-table", {{'A', {-1, 0, 0}}, {'C', {0, 0, -1}}}, {}},
    {"haas-umc", {{'B', {0, -1, 0}}, {'C', {0, 0, -1}}}, {}},
    {"haas-tr", {{'A', {-1, 0, 0}}, {'C', {0, 0, -1}}}, {}},
    {"dmg-dmu", {{'B', {0, -1, 0}}, {'C', {0, 0, -1}}}, {}},
    {"hermle-c", {{'A', {-1, 0, 0}}, {'C', {0, 0, -1}}}, {}},
    {"nutating-table", {{'B', {0, -kHalf, -kHalf}}, {'C', {0, 0, -1}}}, {}},
    {"nutating-head", {{'C', {0, 0, -1}}}, {{'B', {0, kHalf, kHalf}}}},
    {"nutating-head-head", {}, {{'C', {0, 0, 1}}, {'B', {0, kHalf, kHalf}}}},
    {"head-table", {{'C', {0, 0, -1}}}, {{'B', {0, 1, 0}}}},
};
constexpr double kToolLength = 130;

double word(const Joints& joints, char letter) {
    return joints.rotary_rad[letter - 'A'];
}

// Tip and axis in the part: the inverse of the part's displacement times that of the tool. The tool's rotary
// axes pass through the spindle nose.
ToolPose pose_by_matrices(const Chain& chain, const Joints& joints) {
    Matrix part = shift({}), tool = shift(joints.linear_mm);
    // The part's inverse: its turns in the reverse order and sense.
    for (const Axis& axis : chain.part) part = product(turn(axis.direction, -word(joints, axis.word)), part);
    tool = product(tool, shift({0, 0, kToolLength}));
    for (const Axis& axis : chain.tool) tool = product(tool, turn(axis.direction, word(joints, axis.word)));
    tool = product(tool, shift({0, 0, -kToolLength}));
    const Matrix m = product(part, tool);
    return {{m[0][3], m[1][3], m[2][3]}, {m[0][2], m[1][2], m[2][2]}};
}

TEST(NamedMachines, move_as_the_matrices_of_their_chains) {
    for (const Chain& chain : kChains) {
        SCOPED_TRACE(chain.name);
        const auto machine = named_machine(chain.name);
        ASSERT_TRUE(machine);
        ASSERT_TRUE(check(*machine));
        const Kinematics kinematics(*machine, kToolLength);
        for (double first = -110; first <= 110; first += 27.5) {
            for (double second = -300; second <= 300; second += 77) {
                Joints joints{{first, 0.3 * second, 40}, {}};
                joints.rotary_rad = {first * kDeg, first * kDeg, second * kDeg};
                const ToolPose pose = kinematics.pose(joints), should = pose_by_matrices(chain, joints);
                EXPECT_NEAR(distance(pose.tip_mm, should.tip_mm), 0, 1e-9);
                EXPECT_NEAR(distance(pose.axis, should.axis), 0, 1e-12);
                // And back: the joints that reach a pose lead to it.
                const auto reached = kinematics.joints(pose, joints);
                ASSERT_TRUE(reached);
                EXPECT_NEAR(distance(kinematics.pose(reached->joints).tip_mm, pose.tip_mm), 0, 1e-7);
            }
        }
    }
}

TEST(NamedMachines, that_nutate_lay_the_tool_flat_at_half_a_turn) {
    // About (0, 1, 1), half a turn leads z to y.
    const Kinematics table(*named_machine("nutating-table"));
    EXPECT_NEAR(distance(table.axis({0, 180 * kDeg, 0}), {0, 1, 0}), 0, 1e-12);
    const Kinematics head(*named_machine("nutating-head"));
    EXPECT_NEAR(distance(head.axis({0, 180 * kDeg, 0}), {0, 1, 0}), 0, 1e-12);
}

TEST(NamedMachines, have_limits_where_they_stand_for_real_ones) {
    const Machine umc = *named_machine("haas-umc");
    EXPECT_NEAR(umc.axis('B')->max, 120 * kDeg, 1e-12);
    EXPECT_NEAR(umc.axis('C')->max_speed, 8 * 2 * 180 * kDeg / 60, 1e-12);
    const Machine trunnion = *named_machine("xyzac-trt");
    EXPECT_EQ(trunnion.axis('A')->max, std::numeric_limits<double>::infinity());
    EXPECT_EQ(trunnion.axis('A')->max_speed, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace tribo::motion
