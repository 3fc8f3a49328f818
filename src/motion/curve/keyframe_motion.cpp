// SPDX-License-Identifier: MIT
#include "motion/curve/keyframe_motion.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "motion/algebra/direction.hpp"
#include "motion/curve/fitting.hpp"

namespace tribo::motion {

namespace {

std::unexpected<Error> refuse(const Keyframe& keyframe, std::string cause, std::string remedy) {
    return fail_at({}, keyframe.line, 0, std::move(cause), std::move(remedy));
}

Result<void> check_keyframes(std::span<const Keyframe> keyframes) {
    for (const Keyframe& k : keyframes) {
        if (!is_finite(k.pose.tip_mm) || !is_finite(k.pose.axis) || !std::isfinite(k.weight) ||
            !std::isfinite(k.feed_mm_per_min))
            return refuse(k, "a keyframe holds a number that is not finite", "give finite numbers");
        if (!(length(k.pose.axis) > 1e-9))
            return refuse(k, "the tool axis i, j, k has no direction",
                          "give the direction from the tip to the shank, 0, 0, 1 for an upright tool");
        if (!(k.weight > 0))
            return refuse(k, "the weight is not greater than zero",
                          "use weights around 1, or leave the column out");
        if (k.feed_mm_per_min < 0)
            return refuse(k, "the feed is negative", "give mm per minute, or 0 for the feed of the process");
    }
    return {};
}

std::unexpected<Error> refuse_more_than(std::size_t max_moves, const Keyframe& keyframe) {
    return refuse(keyframe,
                  "with this keyframe the motion has more than " + std::to_string(max_moves) + " moves",
                  "split the motion, or check the unit of its coordinates");
}

ToolPose with_unit_axis(ToolPose pose) {
    pose.axis = normalized(pose.axis);
    return pose;
}

// Poses closer than this in mm (or rad) count as one.
constexpr double kSameKey = 1e-9;

// The keyframes that differ from the one before, and the parameters of all keyframes.
struct Stations {
    std::vector<ToolPose> poses;
    std::vector<double> weights, distinct, all;
};

Stations stations_of(std::span<const Keyframe> keyframes, Spacing spacing) {
    Stations s;
    for (const Keyframe& k : keyframes) {
        const ToolPose pose = with_unit_axis(k.pose);
        const double chord = s.poses.empty() ? 0 : pose_chord(s.poses.back(), pose);
        if (!s.poses.empty() && chord < kSameKey) {
            s.all.push_back(s.distinct.back());
            continue;
        }
        const double step = spacing == Spacing::chord ? chord : std::sqrt(chord);
        s.distinct.push_back(s.poses.empty() ? 0 : s.distinct.back() + step);
        s.all.push_back(s.distinct.back());
        s.poses.push_back(pose);
        s.weights.push_back(k.weight);
    }
    return s;
}

BSplineMotion motion_through(const Stations& s, const KeyframeOptions& options) {
    const std::vector<DualQuaternion> frames = minimal_twist_displacements(s.poses);
    const std::span<const double> u(s.distinct);
    if (options.curve == Curve::dual_quaternion) {
        BSpline<DualQuaternion> curve =
            interpolate_cubic(u, std::span<const DualQuaternion>(frames), options.ends, s.weights);
        const std::vector<double> weights = control_weights(s.weights, curve.control.size());
        for (std::size_t i = 0; i < weights.size(); ++i) curve.control[i] = weights[i] * curve.control[i];
        return {curve};
    }
    std::vector<Vec3> tips;
    std::vector<Quaternion> rotations;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        tips.push_back(s.poses[i].tip_mm);
        rotations.push_back(frames[i].real);
    }
    const BSpline<Vec3> path = interpolate_cubic(u, std::span<const Vec3>(tips), options.ends, s.weights);
    const BSpline<Quaternion> turn =
        interpolate_cubic(u, std::span<const Quaternion>(rotations), options.ends);
    const std::vector<double> weights = control_weights(s.weights, path.control.size());
    BSpline<HomogeneousPoint> tip{path.degree, path.knots, {}};
    for (std::size_t i = 0; i < weights.size(); ++i)
        tip.control.push_back({weights[i] * path.control[i], weights[i]});
    return motion_along(tip, turn);
}

Move move_to(const Keyframe& k, double feed_mm_per_min) {
    Move m;
    m.feed_mm_per_min = k.feed_mm_per_min > 0 ? k.feed_mm_per_min : feed_mm_per_min;
    m.line = k.line;
    return m;
}

// Refuses a motion that runs to infinity. The error names the keyframe after the pole.
Result<void> check_poles(const BSplineMotion& motion, std::span<const double> parameters,
                         std::span<const Keyframe> keyframes) {
    const BSpline<DualQuaternion>& spline = motion.spline;
    for (std::size_t k = spline.degree; k < spline.control.size(); ++k) {
        if (spline.knots[k] == spline.knots[k + 1]) continue;
        const MotionPiece piece = bezier_piece(motion, k);
        if (!has_pole(piece.motion)) continue;
        const auto after = std::upper_bound(parameters.begin(), parameters.end(), piece.start);
        const std::size_t i =
            std::min(static_cast<std::size_t>(after - parameters.begin()), keyframes.size() - 1);
        return refuse(keyframes[i], "the motion to this keyframe runs to infinity",
                      "add keyframes where the axis turns by more than 90 degrees");
    }
    return {};
}

struct MoveMaker {
    double feed_mm_per_min;
    const PieceTolerance& tolerance;
    std::size_t max_moves;
    std::vector<Move> moves = {};

    Result<void> add(const BSplineMotion& motion, std::span<const double> parameters,
                     std::span<const Keyframe> keyframes) {
        for (std::size_t i = 1; i < keyframes.size(); ++i) {
            const double from = parameters[i - 1], to = parameters[i];
            if (!(from < to)) continue;
            if (!append_moves(motion, from, to, move_to(keyframes[i], feed_mm_per_min), tolerance,
                              max_moves - moves.size(), moves))
                return refuse_more_than(max_moves, keyframes[i]);
        }
        return {};
    }
};

Result<std::vector<Move>> fitted_moves(std::span<const Keyframe> keyframes, MoveMaker maker) {
    if (const Result<void> good = check_keyframes(keyframes); !good) return std::unexpected(good.error());
    std::vector<ToolPose> poses;
    for (const Keyframe& k : keyframes) poses.push_back(k.pose);
    const Result<MotionFit> fit = fit_motion(poses);
    if (!fit) return std::unexpected(fit.error());
    for (const FittedRun& run : fit->runs) {
        const auto keys = keyframes.subspan(run.first, run.last - run.first + 1);
        if (const Result<void> good = check_poles(run.motion, run.parameters, keys); !good)
            return std::unexpected(good.error());
        if (const Result<void> added = maker.add(run.motion, run.parameters, keys); !added)
            return std::unexpected(added.error());
    }
    return std::move(maker.moves);
}

}  // namespace

double pose_chord(const ToolPose& a, const ToolPose& b) {
    return std::max(distance(a.tip_mm, b.tip_mm), kChordPerRadian * angle_rad(a.axis, b.axis));
}

Result<KeyframeMotion> interpolate_keyframes(std::span<const Keyframe> keyframes,
                                             const KeyframeOptions& options) {
    if (keyframes.size() > kMostSplineKeyframes) {
        return refuse(keyframes[kMostSplineKeyframes],
                      "one spline through " + std::to_string(keyframes.size()) + " keyframes, more than " +
                          std::to_string(kMostSplineKeyframes),
                      "write interpolation = \"fit\" or \"linear\", or split the motion");
    }
    if (const Result<void> good = check_keyframes(keyframes); !good) return std::unexpected(good.error());
    const Stations s = stations_of(keyframes, options.spacing);
    if (s.poses.size() < 2)
        return fail("a motion needs at least two different keyframes", "add keyframes along the path");
    KeyframeMotion result{motion_through(s, options), s.all};
    if (const Result<void> good = check_poles(result.motion, s.all, keyframes); !good)
        return std::unexpected(good.error());
    return result;
}

Result<std::vector<Move>> keyframe_moves(std::span<const Keyframe> keyframes, double feed_mm_per_min,
                                         const KeyframeOptions& options, const PieceTolerance& tolerance) {
    if (options.interpolation == Interpolation::fit)
        return fitted_moves(keyframes, {feed_mm_per_min, tolerance, options.max_moves});
    if (options.interpolation == Interpolation::linear) {
        std::vector<Move> moves;
        if (const Result<void> good = check_keyframes(keyframes); !good) return std::unexpected(good.error());
        if (stations_of(keyframes, options.spacing).poses.size() < 2)
            return fail("a motion needs at least two different keyframes", "add keyframes along the path");
        for (std::size_t i = 1; i < keyframes.size(); ++i) {
            Move m = move_to(keyframes[i], feed_mm_per_min);
            m.start = with_unit_axis(keyframes[i - 1].pose);
            m.end = with_unit_axis(keyframes[i].pose);
            if (pose_chord(m.start, m.end) < kSameKey) continue;
            if (moves.size() == options.max_moves) return refuse_more_than(options.max_moves, keyframes[i]);
            moves.push_back(m);
        }
        return moves;
    }
    const Result<KeyframeMotion> curve = interpolate_keyframes(keyframes, options);
    if (!curve) return std::unexpected(curve.error());
    MoveMaker maker{feed_mm_per_min, tolerance, options.max_moves};
    if (const Result<void> added = maker.add(curve->motion, curve->parameters, keyframes); !added)
        return std::unexpected(added.error());
    return std::move(maker.moves);
}

}  // namespace tribo::motion
