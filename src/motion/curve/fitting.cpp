// SPDX-License-Identifier: MIT
#include "motion/curve/fitting.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "motion/algebra/direction.hpp"

namespace tribo::motion {

namespace {

// Height above the tip of the point whose path shows corners of the axis, mm.
constexpr double kLever = 50;
// Poses closer than this in mm and rad count as one.
constexpr double kSamePose = 1e-6;

// The fitted quantity: the dual quaternion itself, or (Curve::tip) the rotation as real part and the tip as
// vector of the dual part. The latter uses the type only to store eight numbers.
using Sample = DualQuaternion;

struct Run {
    std::vector<Sample> samples;
    std::vector<double> u;  // strictly ascending
    std::vector<ToolPose> poses;
    Curve curve = Curve::tip;

    ToolPose pose_of(const Sample& s) const {
        if (curve == Curve::dual_quaternion) return tool_pose(s);
        return {s.dual.vector(), normalized(rotate(s.real, {0, 0, 1}))};
    }
};

struct Limits {
    double position_mm, angle_rad;
    bool holds(const ToolPose& a, const ToolPose& b) const {
        return distance(a.tip_mm, b.tip_mm) <= position_mm && motion::angle_rad(a.axis, b.axis) <= angle_rad;
    }
};

bool same_pose(const ToolPose& a, const ToolPose& b) {
    return distance(a.tip_mm, b.tip_mm) < kSamePose && distance(a.axis, b.axis) < kSamePose;
}

// Returns true if the polyline a, b, c turns at b by more than the limit. A standstill before or after a
// travel is a corner too.
bool turns(Vec3 a, Vec3 b, Vec3 c, double limit_rad) {
    const bool before = distance(a, b) > kSamePose, after = distance(b, c) > kSamePose;
    if (!before || !after) return before != after;
    return angle_rad(b - a, c - b) > limit_rad;
}

bool is_corner(const ToolPose& a, const ToolPose& b, const ToolPose& c, double limit_rad) {
    const auto up = [](const ToolPose& p) { return p.tip_mm + kLever * p.axis; };
    return turns(a.tip_mm, b.tip_mm, c.tip_mm, limit_rad) || turns(up(a), up(b), up(c), limit_rad);
}

Run run_of(std::span<const ToolPose> poses, Curve curve) {
    Run run;
    run.curve = curve;
    run.poses.assign(poses.begin(), poses.end());
    for (const DualQuaternion& frame : minimal_twist_displacements(poses)) {
        const std::size_t i = run.samples.size();
        run.u.push_back(i == 0 ? 0 : run.u.back() + pose_chord(poses[i - 1], poses[i]));
        run.samples.push_back(curve == Curve::tip ? Sample{frame.real, Quaternion(0, poses[i].tip_mm)}
                                                  : frame);
    }
    return run;
}

// Least squares over all samples; the first and the last are met exactly. Returns false if the knots leave a
// control point without samples.
bool fit_controls(const Run& run, BSpline<Sample>& s) {
    const std::size_t count = s.knots.size() - 4;
    s.control.assign(count, Sample{});
    s.control.front() = run.samples.front();
    s.control.back() = run.samples.back();
    const std::size_t unknown = count - 2;
    BandedMatrix normal(unknown, 3, 3);
    std::vector<Sample> right(unknown);
    for (std::size_t i = 1; i + 1 < run.u.size(); ++i) {
        const std::size_t k = find_span(s, run.u[i]);
        const std::array<double, 4> basis = cubic_basis(s.knots, k, run.u[i]);
        Sample rest = run.samples[i];
        for (std::size_t j = 0; j < 4; ++j)
            if (const std::size_t c = k - 3 + j; c == 0 || c == count - 1)
                rest = rest + (-basis[j]) * s.control[c];
        for (std::size_t a = 0; a < 4; ++a) {
            const std::size_t row = k - 3 + a;
            if (row == 0 || row == count - 1) continue;
            right[row - 1] = right[row - 1] + basis[a] * rest;
            for (std::size_t b = 0; b < 4; ++b) {
                const std::size_t column = k - 3 + b;
                if (column != 0 && column != count - 1) normal.at(row - 1, column - 1) += basis[a] * basis[b];
            }
        }
    }
    if (!normal.solve(right)) return false;
    std::copy(right.begin(), right.end(), s.control.begin() + 1);
    return true;
}

// Returns the clamped knots with these interior ones, ascending.
std::vector<double> clamped(const std::vector<double>& interior, double end) {
    std::vector<double> knots(4, 0.0);
    knots.insert(knots.end(), interior.begin(), interior.end());
    knots.insert(knots.end(), 4, end);
    return knots;
}

// Adds a knot in the middle (by number of samples) of every span with a sample out of tolerance. Returns
// false if a span that needs a knot has fewer than two samples on a side.
bool refine(const Run& run, const BSpline<Sample>& s, const Limits& limits, std::vector<double>& interior,
            bool& off) {
    std::vector<double> edges{0.0};
    edges.insert(edges.end(), interior.begin(), interior.end());
    edges.push_back(run.u.back());
    std::vector<double> refined;
    std::size_t i = 0;
    off = false;
    for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
        const std::size_t first = i;
        bool span_off = false;
        while (i < run.u.size() && (run.u[i] < edges[e + 1] || e + 2 == edges.size())) {
            span_off = span_off || !limits.holds(run.pose_of(evaluate(s, run.u[i])), run.poses[i]);
            ++i;
        }
        if (e > 0) refined.push_back(edges[e]);
        if (!span_off) continue;
        off = true;
        if (i - first < 4) return false;
        const std::size_t middle = first + (i - first) / 2;
        refined.push_back(0.5 * (run.u[middle - 1] + run.u[middle]));
    }
    interior = std::move(refined);
    return true;
}

BSpline<Sample> fitted_spline(const Run& run, const Limits& limits) {
    const auto interpolant = [&] {
        return interpolate_cubic(std::span<const double>(run.u), std::span<const Sample>(run.samples),
                                 EndCondition::natural);
    };
    if (run.u.size() < 4) return interpolant();
    std::vector<double> interior;
    for (;;) {
        BSpline<Sample> s{3, clamped(interior, run.u.back()), {}};
        if (!fit_controls(run, s)) return interpolant();
        bool off = false;
        const bool could = refine(run, s, limits, interior, off);
        if (!off) return s;
        if (!could) return interpolant();
    }
}

BSplineMotion motion_of(const Run& run, const BSpline<Sample>& s) {
    if (run.curve == Curve::dual_quaternion) return {s};
    BSpline<Quaternion> turn{s.degree, s.knots, {}};
    BSpline<HomogeneousPoint> tip{s.degree, s.knots, {}};
    for (const Sample& c : s.control) {
        turn.control.push_back(c.real);
        tip.control.push_back({c.dual.vector(), 1});
    }
    return motion_along(tip, turn);
}

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
    const double along = squared_length(b - a);
    return distance(p, lerp(a, b, along > 0 ? std::clamp(dot(p - a, b - a) / along, 0.0, 1.0) : 0));
}

void measure(const Run& run, const BSplineMotion& motion, MotionFit& fit) {
    for (std::size_t i = 0; i < run.u.size(); ++i) {
        const ToolPose is = motion.pose(run.u[i]), &should = run.poses[i];
        fit.max_position_error_mm = std::max(fit.max_position_error_mm, distance(is.tip_mm, should.tip_mm));
        fit.max_angle_error_rad = std::max(fit.max_angle_error_rad, angle_rad(is.axis, should.axis));
        if (i == 0) continue;
        const Vec3 between = motion.pose(0.5 * (run.u[i - 1] + run.u[i])).tip_mm;
        fit.max_chord_deviation_mm =
            std::max(fit.max_chord_deviation_mm,
                     distance_to_segment(between, run.poses[i - 1].tip_mm, run.poses[i].tip_mm));
    }
}

Result<void> check_poses(std::span<const ToolPose> poses, const FitOptions& o) {
    if (!(o.position_tolerance_mm > 0) || !(o.angle_tolerance_deg > 0) || !(o.corner_deg > 0))
        return fail("a tolerance of the fit is not greater than zero",
                    "give millimetres and degrees above 0");
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const std::string which = "pose " + std::to_string(i + 1);
        if (!is_finite(poses[i].tip_mm) || !is_finite(poses[i].axis))
            return fail(which + " holds a number that is not finite", "give finite numbers");
        if (!(length(poses[i].axis) > 1e-9))
            return fail(which + " has an axis without direction",
                        "give the direction from the tip to the shank, 0, 0, 1 for an upright tool");
    }
    return {};
}

}  // namespace

Result<MotionFit> fit_motion(std::span<const ToolPose> poses, const FitOptions& options) {
    if (const Result<void> good = check_poses(poses, options); !good) return std::unexpected(good.error());
    // The distinct poses, and for each pose of the stream the index of its distinct pose.
    std::vector<ToolPose> distinct;
    std::vector<std::size_t> first_of, which;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const ToolPose pose{poses[i].tip_mm, normalized(poses[i].axis)};
        if (distinct.empty() || !same_pose(distinct.back(), pose)) {
            distinct.push_back(pose);
            first_of.push_back(i);
        }
        which.push_back(distinct.size() - 1);
    }
    if (distinct.size() < 2)
        return fail("a motion needs at least two different poses", "give the poses along the path");

    const double corner_rad = options.corner_deg * math::kRadPerDeg;
    const Limits limits{options.position_tolerance_mm, options.angle_tolerance_deg * math::kRadPerDeg};
    MotionFit fit;
    std::size_t cubic_points = 0;
    for (std::size_t a = 0, b = 1; b < distinct.size(); ++b) {
        const bool at_end = b + 1 == distinct.size();
        if (!at_end && !is_corner(distinct[b - 1], distinct[b], distinct[b + 1], corner_rad)) continue;
        const Run run = run_of(std::span(distinct).subspan(a, b - a + 1), options.curve);
        const BSpline<Sample> spline = fitted_spline(run, limits);
        cubic_points += spline.control.size();
        if (cubic_points > kMostSplineKeyframes) {
            return fail("smooth motions within " + format_decimal(options.position_tolerance_mm) +
                            " mm of the poses up to number " + std::to_string(first_of[b] + 1) +
                            " need more than " + std::to_string(kMostSplineKeyframes) + " control points",
                        "write interpolation = \"linear\", or split the motion");
        }
        FittedRun fitted{motion_of(run, spline), first_of[a], at_end ? poses.size() - 1 : first_of[b], {}};
        for (std::size_t i = fitted.first; i <= fitted.last; ++i)
            fitted.parameters.push_back(run.u[which[i] - a]);
        measure(run, fitted.motion, fit);
        fit.control_points += fitted.motion.spline.control.size();
        fit.runs.push_back(std::move(fitted));
        a = b;
    }
    return fit;
}

}  // namespace tribo::motion
