// SPDX-License-Identifier: MIT
#include "motion/algebra/dual_quaternion.hpp"

#include <cmath>

#include "motion/algebra/direction.hpp"
#include "random_poses.hpp"

using namespace tribo;
using namespace tribo::motion;
using namespace tribo::motion::testing;

TEST(Quaternion, units_multiply_as_hamilton_carved) {
    const Quaternion i(0, 1, 0, 0), j(0, 0, 1, 0), k(0, 0, 0, 1), minus_one(-1, 0, 0, 0);
    EXPECT_EQ(i * j, k);
    EXPECT_EQ(j * k, i);
    EXPECT_EQ(k * i, j);
    EXPECT_EQ(i * i, minus_one);
    EXPECT_EQ(i * j * k, minus_one);
}

TEST(Quaternion, a_quarter_turn_about_z_takes_x_to_y) {
    const double h = std::sqrt(0.5);
    EXPECT_LT(distance(rotate(Quaternion(h, 0, 0, h), {1, 0, 0}), {0, 1, 0}), 1e-15);
}

RC_GTEST_PROP(QuaternionProperty, the_minimal_rotation_arrives_and_turns_by_the_angle_between, ()) {
    const Vec3 a = direction();
    // Some pairs nearly equal, some nearly opposite.
    const int kind = *rc::gen::inRange(0, 3);
    const double tiny = std::pow(10.0, -*rc::gen::inRange(1, 16));
    const Vec3 b = kind == 0 ? direction() : normalized((kind == 1 ? 1.0 : -1.0) * a + tiny * direction());
    const Quaternion q = minimal_rotation(a, b);
    RC_ASSERT(std::abs(norm(q) - 1) < 1e-15);
    RC_ASSERT(distance(rotate(q, a), b) < 2e-15);
    RC_ASSERT(std::abs(2 * std::atan2(length(q.vector()), q.w) - angle_rad(a, b)) < 1e-14);
}

RC_GTEST_PROP(DualQuaternionProperty, the_product_is_associative_and_distributes, ()) {
    const DualQuaternion a = any_dual_quaternion(), b = any_dual_quaternion(), c = any_dual_quaternion();
    RC_ASSERT(gap((a * b) * c, a * (b * c)) < 1e-12);
    RC_ASSERT(gap(a * (b + c), a * b + a * c) < 1e-12);
}

RC_GTEST_PROP(DualQuaternionProperty, products_of_units_stay_unit_and_act_one_after_the_other, ()) {
    const DualQuaternion a = unit(), b = unit();
    const Vec3 p = vector(50);
    RC_ASSERT(std::abs(norm((a * b).real) - 1) < 1e-14);
    RC_ASSERT(distance(transform_point(a * b, p), transform_point(a, transform_point(b, p))) < 1e-11);
}

RC_GTEST_PROP(DualQuaternionProperty, rotation_and_translation_come_back_out, ()) {
    const Quaternion r = rotation();
    const Vec3 t = vector(100);
    const DualQuaternion q = displacement(r, t);
    RC_ASSERT(distance(translation_mm(q), t) < 1e-12);
    RC_ASSERT(distance(translation_mm(-3.5 * q), t) < 1e-12);
}

RC_GTEST_PROP(DualQuaternionProperty, a_pose_survives_the_trip, ()) {
    const ToolPose p = pose(100);
    const ToolPose back = tool_pose(displacement(p));
    RC_ASSERT(distance(p.tip_mm, back.tip_mm) < 1e-12);
    RC_ASSERT(distance(p.axis, back.axis) < 1e-14);
}

RC_GTEST_PROP(DualQuaternionProperty, minimal_twist_frames_hold_their_poses_and_stay_in_one_hemisphere, ()) {
    std::vector<ToolPose> poses;
    for (int i = 0; i < 50; ++i) poses.push_back(pose(100));
    const std::vector<DualQuaternion> frames = minimal_twist_displacements(poses);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const ToolPose back = tool_pose(frames[i]);
        RC_ASSERT(distance(poses[i].tip_mm, back.tip_mm) < 1e-12);
        RC_ASSERT(distance(poses[i].axis, back.axis) < 5e-15);
        if (i == 0) continue;
        RC_ASSERT(dot(frames[i - 1].real, frames[i].real) >= -1e-15);
        // No twist: the turn between neighbours is about a line across both axes.
        const Vec3 about = (frames[i].real * conjugate(frames[i - 1].real)).vector();
        RC_ASSERT(std::abs(dot(about, poses[i].axis)) < 1e-14);
        RC_ASSERT(std::abs(dot(about, poses[i - 1].axis)) < 1e-14);
    }
}
