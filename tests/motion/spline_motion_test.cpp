// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "motion/curve/bezier_motion.hpp"
#include "motion/curve/bspline_motion.hpp"
#include "motion/made_motions.hpp"
#include "random_poses.hpp"

using namespace tribo;
using namespace tribo::motion;
using namespace tribo::motion::testing;

namespace {

// Neighbouring displacements up to a quarter turn apart, weights 0.5..2.
std::vector<DualQuaternion> weighted_controls(std::size_t count) {
    std::vector<DualQuaternion> units{unit()};
    std::vector<double> weights{1.25 + real(0.75)};
    while (units.size() < count) {
        const Quaternion step = normalized(Quaternion(1, vector(0.4)));
        units.push_back(displacement(step, vector(5)) * units.back());
        weights.push_back(1.25 + real(0.75));
    }
    return weighted_motion(units, weights).control;
}

BezierMotion bezier_motion() {
    return {weighted_controls(static_cast<std::size_t>(*rc::gen::inRange(2, 6)))};
}

// Degree 1..5, some interior knots double.
BSplineMotion bspline_motion() {
    BSplineMotion m;
    m.spline.degree = static_cast<std::size_t>(*rc::gen::inRange(1, 6));
    std::vector<double> knots(m.degree() + 1, 0.0);
    double u = 0;
    for (int i = *rc::gen::inRange(0, 5); i > 0; --i) {
        u += 0.6 + real(0.5);
        knots.push_back(u);
        if (m.degree() > 1 && *rc::gen::inRange(0, 3) == 0) knots.push_back(u);
    }
    knots.insert(knots.end(), m.degree() + 1, u + 1);
    m.spline.knots = std::move(knots);
    m.spline.control = weighted_controls(m.spline.knots.size() - m.degree() - 1);
    return m;
}

double inside(const BSplineMotion& m, double t) {
    return m.start() + t * (m.end() - m.start());
}

}  // namespace

RC_GTEST_PROP(BezierMotion, starts_and_ends_at_its_outer_controls, ()) {
    const BezierMotion m = bezier_motion();
    RC_ASSERT(gap(m.at(0), m.control.front()) < 1e-12);
    RC_ASSERT(gap(m.at(1), m.control.back()) < 1e-12);
}

RC_GTEST_PROP(BezierMotion, equals_its_bernstein_sum, ()) {
    const BezierMotion m = bezier_motion();
    const double t = 0.5 + real(0.5);
    DualQuaternion sum;
    for (std::size_t i = 0; i <= m.degree(); ++i)
        sum =
            sum + (binomial(m.degree(), i) * std::pow(t, i) * std::pow(1 - t, m.degree() - i)) * m.control[i];
    RC_ASSERT(gap(sum, m.at(t)) < 1e-11);
}

RC_GTEST_PROP(BezierMotion, subdivision_leaves_the_curve_as_it_is, ()) {
    const BezierMotion m = bezier_motion();
    const double cut = 0.5 + real(0.4), t = 0.5 + real(0.5);
    const auto [left, right] = subdivide(m, cut);
    RC_ASSERT(gap(left.at(t), m.at(cut * t)) < 1e-11);
    RC_ASSERT(gap(right.at(t), m.at(cut + (1 - cut) * t)) < 1e-11);
}

RC_GTEST_PROP(BezierMotion, points_run_on_rational_curves_of_twice_the_degree, ()) {
    const BezierMotion m = bezier_motion();
    const Vec3 p = vector(40);
    const std::vector<HomogeneousPoint> path = point_path(m, p);
    RC_ASSERT(path.size() == 2 * m.degree() + 1);
    for (int i = 0; i <= 20; ++i) {
        const double t = i / 20.0;
        RC_ASSERT(distance(de_casteljau(path, t).point(), transform_point(m.at(t), p)) < 1e-10);
    }
}

RC_GTEST_PROP(BezierMotion, directions_run_on_rational_curves_of_twice_the_degree, ()) {
    const BezierMotion m = bezier_motion();
    const Vec3 v = direction();
    const std::vector<HomogeneousPoint> path = direction_path(m, v);
    for (int i = 0; i <= 20; ++i) {
        const Vec3 u = de_casteljau(path, i / 20.0).point();
        RC_ASSERT(distance(u, transform_direction(m.at(i / 20.0), v)) < 1e-13);
        RC_ASSERT(std::abs(length(u) - 1) < 1e-13);
    }
}

RC_GTEST_PROP(BezierMotion, a_positive_norm_margin_bounds_the_norm, ()) {
    const BezierMotion m = bezier_motion();
    const double margin = norm_margin(m);
    double low = 1e300, high = 0;
    for (int i = 0; i <= 50; ++i) {
        const DualQuaternion q = m.at(i / 50.0);
        low = std::min(low, dot(q.real, q.real));
        high = std::max(high, dot(q.real, q.real));
    }
    RC_ASSERT(margin <= low / high + 1e-12);
}

TEST(BezierMotion, a_pole_is_found_and_a_narrow_miss_is_not_one) {
    // Real parts 1, i, -1: |q|^2 = (1 - 2t)^2 + 4 t^2 (1-t)^2 >= 1/4, though its coefficients touch zero.
    const Quaternion i(0, 1, 0, 0);
    const BezierMotion round{{kIdentityDisplacement, {i, {}}, -kIdentityDisplacement}};
    EXPECT_LE(norm_margin(round), 0);
    EXPECT_FALSE(has_pole(round));
    const BezierMotion through{{kIdentityDisplacement, -0.3 * kIdentityDisplacement, kIdentityDisplacement}};
    EXPECT_FALSE(has_pole(BezierMotion{{kIdentityDisplacement, kIdentityDisplacement}}));
    EXPECT_FALSE(has_pole(through));
    EXPECT_TRUE(has_pole({{kIdentityDisplacement, -kIdentityDisplacement}}));
    EXPECT_TRUE(has_pole({{kIdentityDisplacement, -1.0 * kIdentityDisplacement, kIdentityDisplacement}}));
}

RC_GTEST_PROP(BezierMotion, rates_agree_with_central_differences, ()) {
    const BezierMotion m = bezier_motion();
    const double t = 0.5 + real(0.4), h = 1e-6;
    const PoseRates r = rates(m, t);
    const ToolPose after = m.pose(t + h), before = m.pose(t - h);
    RC_ASSERT(distance(r.tip_rate_mm, (after.tip_mm - before.tip_mm) / (2 * h)) < 1e-5);
    RC_ASSERT(distance(r.axis_rate, (after.axis - before.axis) / (2 * h)) < 1e-7);
    RC_ASSERT(std::abs(dot(r.axis_rate, r.pose.axis)) < 1e-12);
}

TEST(BezierMotion, of_pure_shifts_is_the_rational_bezier_curve_of_the_points) {
    // A quarter circle, weights 1, 1, 2 (Farin 2002, 12.2): the motion of degree 2 shifts the tip along it.
    const std::vector<DualQuaternion> units{displacement(kIdentityQuaternion, {10, 0, 0}),
                                            displacement(kIdentityQuaternion, {10, 10, 0}),
                                            displacement(kIdentityQuaternion, {0, 10, 0})};
    const std::vector<double> weights{1, 1, 2};
    const BezierMotion m = weighted_motion(units, weights);
    for (int i = 0; i <= 10; ++i) EXPECT_NEAR(length(m.pose(i / 10.0).tip_mm), 10, 1e-14);
}

TEST(BezierMotion, of_degree_one_between_two_turns_keeps_to_the_great_circle) {
    const std::vector<ToolPose> poses{{{0, 0, 0}, {0, 0, 1}}, {{0, 0, 0}, {1, 0, 0}}};
    const std::vector<double> weights{1, 1};
    const BezierMotion m = weighted_motion(minimal_twist_displacements(poses), weights);
    for (int i = 0; i <= 10; ++i) EXPECT_NEAR(m.pose(i / 10.0).axis.y, 0, 1e-16);
    EXPECT_LT(distance(m.pose(0.5).axis, normalized(Vec3{1, 0, 1})), 1e-15);
}

RC_GTEST_PROP(BSplineMotion, agrees_with_the_cox_de_boor_basis, ()) {
    const BSplineMotion m = bspline_motion();
    const BSpline<DualQuaternion>& s = m.spline;
    const double u = inside(m, 0.499 + real(0.499));
    std::vector<double> basis(s.knots.size() - 1);
    for (std::size_t i = 0; i < basis.size(); ++i) basis[i] = s.knots[i] <= u && u < s.knots[i + 1];
    for (std::size_t d = 1; d <= s.degree; ++d)
        for (std::size_t i = 0; i + d + 1 < s.knots.size(); ++i) {
            const double a = s.knots[i + d] - s.knots[i], b = s.knots[i + d + 1] - s.knots[i + 1];
            basis[i] = (a > 0 ? (u - s.knots[i]) / a * basis[i] : 0) +
                       (b > 0 ? (s.knots[i + d + 1] - u) / b * basis[i + 1] : 0);
        }
    DualQuaternion sum;
    for (std::size_t i = 0; i < s.control.size(); ++i) sum = sum + basis[i] * s.control[i];
    RC_ASSERT(gap(sum, m.at(u)) < 1e-11);
}

RC_GTEST_PROP(BSplineMotion, its_bezier_pieces_are_the_curve, ()) {
    const BSplineMotion m = bspline_motion();
    double reached = m.start();
    for (const MotionPiece& piece : bezier_pieces(m)) {
        RC_ASSERT(piece.start == reached);
        reached = piece.end;
        for (int i = 0; i < 10; ++i) {
            const double t = (i + 0.5) / 10;
            RC_ASSERT(gap(piece.motion.at(t), m.at(piece.start + t * (piece.end - piece.start))) < 1e-11);
        }
    }
    RC_ASSERT(reached == m.end());
}

RC_GTEST_PROP(BSplineMotion, rates_agree_with_those_of_its_bezier_pieces, ()) {
    const BSplineMotion m = bspline_motion();
    for (const MotionPiece& piece : bezier_pieces(m)) {
        const double width = piece.end - piece.start;
        const PoseRates whole = rates(m, piece.start + 0.3 * width), part = rates(piece.motion, 0.3);
        RC_ASSERT(distance(width * whole.tip_rate_mm, part.tip_rate_mm) < 1e-9);
        RC_ASSERT(distance(width * whole.axis_rate, part.axis_rate) < 1e-11);
    }
}

TEST(BSpline, refuses_knots_that_make_it_jump) {
    BSpline<double> s{2, {0, 0, 0, 1, 2, 2, 2}, {1, 2, 3, 4}};
    EXPECT_TRUE(is_valid(s));
    s = {2, {0, 0, 0, 1, 1, 2, 2, 2}, {1, 2, 3, 4, 5}};
    EXPECT_TRUE(is_valid(s));
    s = {2, {0, 0, 0, 1, 1, 1, 2, 2, 2}, {1, 2, 3, 4, 5, 6}};
    EXPECT_FALSE(is_valid(s));
    s = {2, {0, 0, 0, 2, 1, 2, 2, 2}, {1, 2, 3, 4, 5}};
    EXPECT_FALSE(is_valid(s));
    s = {2, {0, 0, 1, 2, 2, 2}, {1, 2, 3}};
    EXPECT_FALSE(is_valid(s));
}
