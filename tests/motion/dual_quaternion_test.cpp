// SPDX-License-Identifier: MIT
#include "motion/algebra/dual_quaternion.hpp"

#include <cmath>
#include <numbers>

#include "motion/algebra/direction.hpp"
#include "random_poses.hpp"

using namespace tribo;
using namespace tribo::motion;
using namespace tribo::motion::testing;

namespace {
constexpr double kPi = std::numbers::pi;
}

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

RC_GTEST_PROP(DualQuaternionProperty, conjugates_reverse_or_keep_the_order_of_a_product, ()) {
    const DualQuaternion a = any_dual_quaternion(), b = any_dual_quaternion();
    RC_ASSERT(gap(quaternion_conjugate(a * b), quaternion_conjugate(b) * quaternion_conjugate(a)) < 1e-13);
    RC_ASSERT(gap(dual_conjugate(a * b), dual_conjugate(a) * dual_conjugate(b)) < 1e-13);
    RC_ASSERT(gap(combined_conjugate(a * b), combined_conjugate(b) * combined_conjugate(a)) < 1e-13);
    RC_ASSERT(combined_conjugate(a) == dual_conjugate(quaternion_conjugate(a)));
}

RC_GTEST_PROP(DualQuaternionProperty, the_norm_is_multiplicative_as_a_dual_number, ()) {
    const DualQuaternion a = any_dual_quaternion(), b = any_dual_quaternion();
    RC_PRE(norm(a.real) > 0.01 && norm(b.real) > 0.01);
    const DualNumber na = norm(a), nb = norm(b), nab = norm(a * b);
    RC_ASSERT(std::abs(nab.real - na.real * nb.real) < 1e-12);
    RC_ASSERT(std::abs(nab.dual - (na.real * nb.dual + na.dual * nb.real)) < 1e-10);
}

RC_GTEST_PROP(DualQuaternionProperty, normalising_gives_norm_one_and_keeps_the_displacement, ()) {
    const DualQuaternion a = any_dual_quaternion();
    RC_PRE(norm(a.real) > 0.01);
    const DualQuaternion u = normalized(a);
    const DualNumber n = norm(u);
    RC_ASSERT(std::abs(n.real - 1) < 1e-15);
    RC_ASSERT(std::abs(n.dual) < 1e-12);
    RC_ASSERT(displacement_gap_mm(a, u) < 1e-9);
}

RC_GTEST_PROP(DualQuaternionProperty, products_of_units_stay_unit_and_act_one_after_the_other, ()) {
    const DualQuaternion a = unit(), b = unit();
    const Vec3 p = vector(50);
    RC_ASSERT(std::abs(norm(a * b).real - 1) < 1e-14);
    RC_ASSERT(std::abs(norm(a * b).dual) < 1e-12);
    RC_ASSERT(distance(transform_point(a * b, p), transform_point(a, transform_point(b, p))) < 1e-11);
    RC_ASSERT(gap(a * quaternion_conjugate(a), kIdentityDisplacement) < 1e-12);
}

RC_GTEST_PROP(DualQuaternionProperty, the_sandwich_with_the_combined_conjugate_moves_a_point, ()) {
    // 1 + e p -> Q (1 + e p) Q^+ = 1 + e p', the textbook form
    const DualQuaternion q = unit();
    const Vec3 p = vector(50);
    const DualQuaternion moved =
        q * DualQuaternion{kIdentityQuaternion, Quaternion(0, p)} * combined_conjugate(q);
    RC_ASSERT(distance(moved.dual.vector(), transform_point(q, p)) < 1e-11);
    RC_ASSERT(norm(moved.real - kIdentityQuaternion) < 1e-14);
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

RC_GTEST_PROP(ScrewProperty, screw_and_displacement_are_each_others_inverse, ()) {
    const DualQuaternion q = unit();
    const Screw s = screw_of(q);
    RC_PRE(s.angle_rad > 1e-3 && s.angle_rad < kPi - 1e-3);
    RC_ASSERT(displacement_gap_mm(displacement(s), q) < 1e-8);
    RC_ASSERT(std::abs(dot(s.point_mm, s.direction)) < 1e-8 * (1 + length(s.point_mm)));
    // Points of the line are only shifted along it.
    const Vec3 moved = transform_point(q, s.point_mm);
    RC_ASSERT(distance(moved, s.point_mm + s.shift_mm * s.direction) < 1e-8);
}

TEST(Screw, of_a_pure_shift_a_pure_turn_and_nothing) {
    const Screw shift = screw_of(displacement(kIdentityQuaternion, {3, 4, 0}));
    EXPECT_EQ(shift.angle_rad, 0);
    EXPECT_DOUBLE_EQ(shift.shift_mm, 5);
    EXPECT_LT(distance(shift.direction, {0.6, 0.8, 0}), 1e-15);
    EXPECT_TRUE(std::isinf(shift.pitch_mm_per_rad()));
    // A quarter turn about the line x = 2, y = 0, along z, rising 3.
    const Screw quarter = screw_of(displacement(Screw{{2, 0, 0}, {0, 0, 1}, kPi / 2, 3}));
    EXPECT_NEAR(quarter.angle_rad, kPi / 2, 1e-15);
    EXPECT_LT(distance(quarter.point_mm, {2, 0, 0}), 1e-15);
    EXPECT_NEAR(quarter.pitch_mm_per_rad(), 6 / kPi, 1e-15);
    EXPECT_EQ(screw_of(kIdentityDisplacement).shift_mm, 0);
}

RC_GTEST_PROP(ScrewProperty, exp_undoes_log, ()) {
    const DualQuaternion q = unit();
    RC_PRE(q.real.w > -0.999);
    RC_ASSERT(gap(exp(log(q)), q) < 1e-10);
}

TEST(Screw, exp_undoes_log_at_small_turns_and_at_a_full_one) {
    for (const double h : {0.0, 1e-300, 1e-12, 1e-5, 9.9e-5, 1.01e-4, 1e-3}) {
        const DualQuaternion q = displacement(
            normalized(Quaternion(std::cos(h), std::sin(h) * normalized(Vec3{1, 2, -2}))), {40, -3, 7});
        EXPECT_LT(gap(exp(log(q)), q), 1e-13) << h;
    }
    const DualQuaternion full{-1.0 * kIdentityQuaternion, Quaternion(0, 3, 4, 0)};
    EXPECT_LT(gap(exp(log(full)), full), 1e-14);
}

RC_GTEST_PROP(ScrewProperty, interpolation_meets_both_ends_and_stays_unit, ()) {
    const DualQuaternion a = unit(), b = unit();
    const double t = 0.5 + real(0.5);
    RC_ASSERT(gap(screw_interpolate(a, b, 0), a) < 1e-12);
    RC_ASSERT(displacement_gap_mm(screw_interpolate(a, b, 1), b) < 1e-9);
    RC_ASSERT(displacement_gap_mm(screw_interpolate(a, -b, t), screw_interpolate(a, b, t)) < 1e-9);
    const DualNumber n = norm(screw_interpolate(a, b, t));
    RC_ASSERT(std::abs(n.real - 1) < 1e-13);
    RC_ASSERT(std::abs(n.dual) < 1e-10);
}

RC_GTEST_PROP(ScrewProperty, interpolation_runs_one_screw_at_constant_pitch, ()) {
    const DualQuaternion a = unit(), b = unit();
    const double t = 0.1 + 0.4 * (1 + real(1));
    const Screw whole = screw_of(b * quaternion_conjugate(a));
    RC_PRE(whole.angle_rad > 0.05 && whole.angle_rad < kPi - 0.01);
    const Screw part = screw_of(screw_interpolate(a, b, t) * quaternion_conjugate(a));
    RC_ASSERT(std::abs(part.angle_rad - t * whole.angle_rad) < 1e-12);
    RC_ASSERT(std::abs(part.shift_mm - t * whole.shift_mm) < 1e-8);
    RC_ASSERT(std::abs(part.pitch_mm_per_rad() - whole.pitch_mm_per_rad()) < 1e-6);
    RC_ASSERT(distance(part.direction, whole.direction) < 1e-11);
    RC_ASSERT(distance(part.point_mm, whole.point_mm) < 1e-6 * (1 + length(whole.point_mm)));
}
