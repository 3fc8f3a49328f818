// SPDX-License-Identifier: MIT
#include "motion/curve/fitting.hpp"

#include <cmath>
#include <numbers>

#include "motion/algebra/direction.hpp"
#include "random_poses.hpp"

using namespace tribo;
using namespace tribo::motion;
using namespace tribo::motion::testing;

namespace {

// A smooth five-axis path of about 190 mm.
ToolPose smooth(double t) {
    const double x = 120 * t;
    return {{x, 15 * std::sin(x / 12), 6 * std::cos(x / 17)},
            normalized(Vec3{0.5 * std::sin(x / 20), 0.4 * std::cos(x / 15), 1})};
}

std::vector<ToolPose> stream(int count) {
    std::vector<ToolPose> poses;
    for (int i = 0; i < count; ++i) poses.push_back(smooth(static_cast<double>(i) / (count - 1)));
    return poses;
}

void expect_within(const MotionFit& fit, const std::vector<ToolPose>& poses, double mm, double deg) {
    double worst_mm = 0, worst_rad = 0;
    std::size_t next = 0;
    for (const FittedRun& run : fit.runs) {
        ASSERT_TRUE(is_valid(run.motion.spline));
        ASSERT_EQ(run.first, next);
        next = run.last;
        ASSERT_EQ(run.parameters.size(), run.last - run.first + 1);
        for (std::size_t i = run.first; i <= run.last; ++i) {
            const ToolPose p = run.motion.pose(run.parameters[i - run.first]);
            worst_mm = std::max(worst_mm, distance(p.tip_mm, poses[i].tip_mm));
            worst_rad = std::max(worst_rad, angle_rad(p.axis, poses[i].axis));
        }
    }
    EXPECT_EQ(next, poses.size() - 1);
    EXPECT_LE(worst_mm, mm);
    EXPECT_LE(worst_rad, deg * std::numbers::pi / 180);
    EXPECT_NEAR(worst_mm, fit.max_position_error_mm, 1e-12);
    EXPECT_NEAR(worst_rad, fit.max_angle_error_rad, 1e-12);
}

}  // namespace

TEST(Fit, a_smooth_stream_becomes_one_c2_motion_within_the_tolerance_with_far_fewer_controls) {
    const std::vector<ToolPose> poses = stream(2000);
    for (const Curve curve : {Curve::tip, Curve::dual_quaternion})
        for (const double mm : {0.1, 0.01, 0.001}) {
            FitOptions o;
            o.position_tolerance_mm = mm;
            o.angle_tolerance_deg = 5 * mm;
            o.curve = curve;
            const Result<MotionFit> fit = fit_motion(poses, o);
            ASSERT_TRUE(fit);
            ASSERT_EQ(fit->runs.size(), 1u);
            expect_within(*fit, poses, mm, 5 * mm);
            EXPECT_LT(fit->control_points, 700u);
            const BSpline<DualQuaternion>& s = fit->runs[0].motion.spline;
            // C2: no interior knot more often than degree - 2.
            for (std::size_t i = s.degree + 1; i + 2 * s.degree - 1 < s.knots.size(); ++i)
                EXPECT_LT(s.knots[i], s.knots[i + s.degree - 2]);
            // Between the poses it does not wiggle: 0.095 mm apart, radius of curvature above 9 mm.
            EXPECT_LT(fit->max_chord_deviation_mm, 2 * mm + 0.095 * 0.095 / 72);
        }
}

TEST(Fit, meets_the_first_and_the_last_pose_exactly) {
    const std::vector<ToolPose> poses = stream(300);
    const Result<MotionFit> fit = fit_motion(poses);
    ASSERT_TRUE(fit);
    const BSplineMotion& m = fit->runs[0].motion;
    EXPECT_LT(distance(m.pose(m.start()).tip_mm, poses.front().tip_mm), 1e-12);
    EXPECT_LT(distance(m.pose(m.end()).tip_mm, poses.back().tip_mm), 1e-12);
    EXPECT_LT(angle_rad(m.pose(m.end()).axis, poses.back().axis), 1e-12);
}

TEST(Fit, a_tolerance_below_what_least_squares_reaches_is_met_by_interpolation) {
    std::vector<ToolPose> poses = stream(60);
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i].tip_mm.z += i % 2 == 0 ? 0.02 : -0.02;
    FitOptions o;
    o.position_tolerance_mm = 1e-3;
    const Result<MotionFit> fit = fit_motion(poses, o);
    ASSERT_TRUE(fit);
    expect_within(*fit, poses, 1e-3, 0.05);
}

TEST(Fit, corners_stay_sharp) {
    std::vector<ToolPose> poses;
    for (int i = 0; i <= 50; ++i) poses.push_back({{0.5 * i, 0, 0}});
    for (int i = 1; i <= 50; ++i) poses.push_back({{25, 0.5 * i, 0}});
    const Result<MotionFit> fit = fit_motion(poses);
    ASSERT_TRUE(fit);
    ASSERT_EQ(fit->runs.size(), 2u);
    EXPECT_EQ(fit->runs[0].last, 50u);
    expect_within(*fit, poses, 1e-9, 1e-9);
    EXPECT_LT(fit->max_chord_deviation_mm, 1e-9);
}

TEST(Fit, a_corner_of_the_axis_alone_stays_sharp) {
    // The tip goes straight on; the axis starts to turn at once by 0.05 rad per mm.
    std::vector<ToolPose> poses;
    for (int i = 0; i <= 20; ++i) poses.push_back({{1.0 * i, 0, 0}, {0, 0, 1}});
    for (int i = 1; i <= 20; ++i) {
        const double a = 0.05 * i;
        poses.push_back({{20.0 + i, 0, 0}, {0, std::sin(a), std::cos(a)}});
    }
    const Result<MotionFit> fit = fit_motion(poses);
    ASSERT_TRUE(fit);
    ASSERT_EQ(fit->runs.size(), 2u);
    EXPECT_EQ(fit->runs[0].last, 20u);
    expect_within(*fit, poses, 0.01, 0.05);
}

TEST(Fit, a_turn_on_the_spot_is_a_run_of_its_own) {
    std::vector<ToolPose> poses;
    for (int i = 0; i <= 10; ++i) poses.push_back({{1.0 * i, 0, 0}, {0, 0, 1}});
    for (int i = 1; i <= 10; ++i) poses.push_back({{10, 0, 0}, {std::sin(0.1 * i), 0, std::cos(0.1 * i)}});
    const Vec3 leaning = poses.back().axis;
    for (int i = 1; i <= 10; ++i) poses.push_back({{10.0 + i, 0, 0}, leaning});
    const Result<MotionFit> fit = fit_motion(poses);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->runs.size(), 3u);
    expect_within(*fit, poses, 0.01, 0.05);
    for (int i = 0; i <= 20; ++i) {
        const BSplineMotion& turn = fit->runs[1].motion;
        EXPECT_LT(distance(turn.pose(turn.end() * i / 20).tip_mm, {10, 0, 0}), 1e-12);
    }
}

TEST(Fit, repeated_poses_and_axes_that_are_not_unit_do_not_disturb) {
    std::vector<ToolPose> poses = stream(200), doubled;
    for (const ToolPose& p : poses) {
        doubled.push_back({p.tip_mm, 3 * p.axis});
        doubled.push_back(p);
    }
    const Result<MotionFit> fit = fit_motion(doubled);
    ASSERT_TRUE(fit);
    expect_within(*fit, doubled, 0.01, 0.05);
    EXPECT_EQ(fit->runs.size(), 1u);
}

RC_GTEST_PROP(FitProperty, any_stream_is_met_within_the_tolerance, ()) {
    std::vector<ToolPose> poses{pose(50)};
    for (int i = *rc::gen::inRange(1, 60); i > 0; --i) {
        const ToolPose& last = poses.back();
        poses.push_back({last.tip_mm + std::pow(10.0, real(1.5)) * normalized(Vec3{1.5, 0, 0} + vector(1)),
                         slerp(last.axis, direction(), 0.2)});
    }
    FitOptions o;
    o.position_tolerance_mm = std::pow(10.0, -2 + real(1.5));
    o.curve = *rc::gen::arbitrary<bool>() ? Curve::tip : Curve::dual_quaternion;
    const Result<MotionFit> fit = fit_motion(poses, o);
    RC_ASSERT(fit.has_value());
    RC_ASSERT(fit->max_position_error_mm <= o.position_tolerance_mm + 1e-9);
    RC_ASSERT(fit->max_angle_error_rad <= o.angle_tolerance_deg * std::numbers::pi / 180 + 1e-9);
}

TEST(Fit, bad_streams_are_refused_with_a_remedy) {
    const auto refused = [](const std::vector<ToolPose>& poses, const FitOptions& o, const char* word) {
        const Result<MotionFit> fit = fit_motion(poses, o);
        ASSERT_FALSE(fit);
        EXPECT_NE(fit.error().cause.find(word), std::string::npos) << fit.error().cause;
        EXPECT_FALSE(fit.error().remedy.empty());
    };
    refused({}, {}, "two different");
    refused({smooth(0), smooth(0)}, {}, "two different");
    refused({smooth(0), {{NAN, 0, 0}}}, {}, "pose 2");
    refused({{{0, 0, 0}, {0, 0, 0}}, smooth(1)}, {}, "pose 1");
    FitOptions o;
    o.position_tolerance_mm = 0;
    refused(stream(5), o, "tolerance");
}
