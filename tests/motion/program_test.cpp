// SPDX-License-Identifier: MIT
#include "motion/path/program.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "motion/algebra/direction.hpp"
#include "motion/path/path.hpp"

using namespace tribo;
using namespace tribo::motion;

namespace {

constexpr double kPi = std::numbers::pi;

Move straight(ToolPose a, ToolPose b) {
    Move m;
    m.start = a;
    m.end = b;
    return m;
}

Move helix(Vec3 start, Vec3 centre, Vec3 normal, double turn, double rise) {
    Move m;
    m.arc = Arc{centre, normal, turn};
    m.start.tip_mm = start;
    m.end.tip_mm = centre + turned(start - centre, normalized(normal), turn) + rise * normalized(normal);
    return m;
}

Move quadratic(Vec3 a, Vec3 c, Vec3 b) {
    Move m;
    m.start.tip_mm = a;
    m.end.tip_mm = b;
    m.quadratic = Quadratic{c, {0, 0, 1}};
    return m;
}

void expect_near(Vec3 a, Vec3 b, double tolerance) {
    EXPECT_LE(distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

double chord_length(const Move& m, int pieces) {
    double sum = 0;
    for (int i = 0; i < pieces; ++i)
        sum += distance(pose_at(m, static_cast<double>(i) / pieces).tip_mm,
                        pose_at(m, static_cast<double>(i + 1) / pieces).tip_mm);
    return sum;
}

void expect_box_holds_path_tightly(const Move& m) {
    const Box3 box = tip_bounds(m);
    Box3 sampled;
    for (int i = 0; i <= 20000; ++i) {
        const Vec3 p = pose_at(m, i / 20000.0).tip_mm;
        sampled.include(p);
        ASSERT_TRUE(box.inflated(1e-12).contains(p));
    }
    expect_near(box.min, sampled.min, 2e-5);
    expect_near(box.max, sampled.max, 2e-5);
}

}  // namespace

TEST(Pose, a_straight_move_turns_its_axis_along_the_great_circle_at_constant_speed) {
    const Move m = straight({{0, 0, 0}, {0, 0, 1}}, {{10, 0, 5}, {1, 0, 0}});
    for (int i = 0; i <= 10; ++i) {
        const double t = i / 10.0;
        const ToolPose p = pose_at(m, t);
        expect_near(p.tip_mm, {10 * t, 0, 5 * t}, 1e-14);
        expect_near(p.axis, {std::sin(t * kPi / 2), 0, std::cos(t * kPi / 2)}, 1e-14);
    }
}

TEST(Pose, nearly_equal_and_opposite_axes_stay_unit_and_meet_their_ends) {
    for (const double angle : {1e-12, 1e-7, 1e-3, 3.0, kPi - 1e-9, kPi}) {
        const Vec3 b{std::sin(angle), 0, angle == kPi ? -1 : std::cos(angle)};
        const Move m = straight({{}, {0, 0, 1}}, {{}, angle == kPi ? Vec3{0, 0, -1} : b});
        EXPECT_EQ(pose_at(m, 0), m.start);
        EXPECT_EQ(pose_at(m, 1), m.end);
        const Vec3 middle = pose_at(m, 0.5).axis;
        EXPECT_NEAR(length(middle), 1, 1e-15);
        EXPECT_NEAR(angle_rad(middle, m.start.axis), angle / 2, 1e-9);
        EXPECT_NEAR(angle_rad(middle, m.end.axis), angle / 2, 1e-9);
    }
}

TEST(Pose, a_helix_of_several_turns_follows_its_closed_form) {
    const Move m = helix({7, 0, 2}, {2, 0, 0}, {0, 0, 2}, 7 * kPi, 21);
    for (int i = 0; i <= 100; ++i) {
        const double t = i / 100.0, p = 7 * kPi * t;
        expect_near(pose_at(m, t).tip_mm, {2 + 5 * std::cos(p), 5 * std::sin(p), 2 + 21 * t}, 1e-12);
    }
}

TEST(Pose, an_arc_whose_end_is_off_its_circle_by_rounding_still_joins) {
    Move m = helix({10, 0, 0}, {0, 0, 0}, {0, 0, -1}, kPi / 2, 0);
    m.end.tip_mm = {0.0004, -9.9997, 0};
    expect_near(pose_at(m, 1 - 1e-9).tip_mm, m.end.tip_mm, 1e-7);
}

TEST(PathLength, straight_arc_and_helix_are_exact) {
    EXPECT_DOUBLE_EQ(path_length_mm(straight({{1, 2, 3}}, {{4, 6, 15}})), 13);
    EXPECT_NEAR(path_length_mm(helix({5, 0, 0}, {}, {0, 0, 1}, -kPi, 0)), 5 * kPi, 1e-13);
    EXPECT_NEAR(path_length_mm(helix({5, 0, 0}, {}, {0, 0, 1}, 10 * kPi, 8)),
                std::sqrt(std::pow(50 * kPi, 2) + 64), 1e-11);
}

TEST(PathLength, a_parabola_has_its_textbook_length) {
    // y = x^2 over 0..1: sqrt(5)/2 + asinh(2)/4
    const double exact = std::sqrt(5.0) / 2 + std::asinh(2.0) / 4;
    EXPECT_NEAR(path_length_mm(quadratic({0, 0, 0}, {0.5, 0, 0}, {1, 1, 0})), exact, 1e-14);
}

TEST(PathLength, quadratics_from_flat_to_cusped_agree_with_many_chords) {
    const Move flat = quadratic({0, 0, 0}, {5.0001, 1e-4, 0}, {10, 0, 0});
    const Move bent = quadratic({0, 0, 0}, {5, 3, 0}, {10, 0, 2});
    const Move sharp = quadratic({0, 0, 0}, {10, 1e-3, 0}, {1, 0, 0});
    const Move there_and_back = quadratic({0, 0, 0}, {1, 0, 0}, {0, 0, 0});
    for (const Move& m : {flat, bent}) EXPECT_NEAR(path_length_mm(m), chord_length(m, 20000), 2e-8);
    EXPECT_NEAR(path_length_mm(sharp), chord_length(sharp, 400000), 1e-6);
    EXPECT_NEAR(path_length_mm(there_and_back), 1, 1e-12);
    EXPECT_EQ(path_length_mm(quadratic({1, 1, 1}, {1, 1, 1}, {1, 1, 1})), 0);
}

TEST(PathLength, the_parameter_at_a_length_has_that_length_behind_it) {
    for (const Move& m :
         {quadratic({0, 0, 0}, {9, 1, 0}, {2, 0, 3}), quadratic({0, 0, 0}, {1, 0, 0}, {0, 0, 0}),
          helix({5, 0, 0}, {}, {0, 0, 1}, 9, 4), straight({{1, 2, 3}}, {{4, 6, 15}})}) {
        const double whole = path_length_mm(m);
        for (int i = 0; i <= 20; ++i) {
            const double t = parameter_at_length(m, whole * i / 20.0);
            EXPECT_NEAR(path_length_mm(m, t), whole * i / 20.0, 1e-11 * whole);
        }
    }
}

TEST(Curvature, of_arc_helix_parabola_and_cusp) {
    EXPECT_NEAR(max_curvature_per_mm(helix({5, 0, 0}, {}, {0, 0, 1}, 3, 0)), 0.2, 1e-15);
    EXPECT_NEAR(max_curvature_per_mm(helix({5, 0, 0}, {}, {0, 0, 1}, 2, 24)), 5.0 / (25 + 144), 1e-15);
    // y = x^2 over -1..1: 2 at the vertex; over 1..2 it is largest at 1: 2 / 5^1.5
    EXPECT_NEAR(max_curvature_per_mm(quadratic({-1, 1, 0}, {0, -1, 0}, {1, 1, 0})), 2, 1e-14);
    EXPECT_NEAR(max_curvature_per_mm(quadratic({1, 1, 0}, {1.5, 2, 0}, {2, 4, 0})), 2 / std::pow(5, 1.5),
                1e-14);
    EXPECT_TRUE(std::isinf(max_curvature_per_mm(quadratic({0, 0, 0}, {1, 0, 0}, {0, 0, 0}))));
    EXPECT_EQ(max_curvature_per_mm(straight({{1, 2, 3}}, {{4, 6, 15}})), 0);
}

TEST(Bounds, hold_every_path_and_touch_it) {
    expect_box_holds_path_tightly(straight({{1, 2, 3}}, {{4, -6, 15}}));
    expect_box_holds_path_tightly(quadratic({0, 0, 0}, {5, 9, -4}, {1, 2, 3}));
    expect_box_holds_path_tightly(helix({5, 1, 0}, {1, 1, 0}, {0, 0, 1}, 2.2, 0));
    expect_box_holds_path_tightly(helix({5, 1, 0}, {1, 1, 0}, {0, 0, 1}, -5.5, 0));
    expect_box_holds_path_tightly(helix({5, 1, 0}, {1, 1, 0}, {0, 0, 1}, 13, 6));
    expect_box_holds_path_tightly(helix({5, 1, 2}, {1, 1, 0}, {1, 2, -3}, 16.5, -3));
    expect_box_holds_path_tightly(helix({5, 1, 2}, {1, 1, 0}, {1, 2, -3}, -11.1, 40));
}

TEST(Bounds, a_full_circle_reaches_its_radius_on_every_side) {
    const Box3 box = tip_bounds(helix({3, 4, 1}, {0, 0, 1}, {0, 0, 1}, 2 * kPi, 0));
    expect_near(box.min, {-5, -5, 1}, 1e-14);
    expect_near(box.max, {5, 5, 1}, 1e-14);
}

TEST(Derivative, of_every_kind_agrees_with_central_differences) {
    for (const Move& m : {quadratic({0, 0, 0}, {9, 1, 0}, {2, 0, 3}), helix({5, 0, 1}, {}, {1, 1, 1}, 9, 4),
                          straight({{1, 2, 3}}, {{4, 6, 15}})})
        for (const double t : {0.1, 0.5, 0.83}) {
            const double h = 1e-5;
            const Vec3 d = (pose_at(m, t + h).tip_mm - pose_at(m, t - h).tip_mm) / (2 * h);
            expect_near(tip_derivative_mm(m, t), d, 1e-6);
        }
}
