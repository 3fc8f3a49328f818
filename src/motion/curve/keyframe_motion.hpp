// SPDX-License-Identifier: MIT
// The motion through keyframes. Allocates its result; any thread.
//
// The turn of a cutter of revolution about its axis is free; the frames take the turn that never twists
// (minimal_twist_displacements). Direct interpolation of dual quaternions (Curve::dual_quaternion) does not
// depend on the choice of frames, in the stock and in the tool. Therefore the tip swings off the line of its
// keyframes by about L t / 8 over a stretch of L mm in which the axis turns by t rad, like a screw. The
// default (Curve::tip) keeps the tip on the path of its points: Q(u) = (w + e/2 P) q with P / w the rational
// cubic spline through the tips and q the cubic spline through the rotations, all C2. The control points of w
// are the weights, so that w > 0. This product is a spline of degree 6 in dual quaternion space; its fourfold
// knots make it C2. Collinear tips with any axes stay collinear, equal axes stay equal. Sources: Juttler &
// Wagner 1996 (translation and rotation of a rational motion are independent); Ge & Ravani 1991.
#pragma once

#include <span>
#include <vector>

#include "motion/algebra/cubic_interpolation.hpp"
#include "motion/curve/bspline_motion.hpp"
#include "motion/curve/keyframe.hpp"
#include "motion/path/moves.hpp"

namespace tribo::motion {

// spline: one motion through all keyframes. linear: straight moves from one to the next. fit: smooth motions
// from corner to corner (fitting.hpp), for paths of many keyframes with corners.
enum class Interpolation { spline, linear, fit };
enum class Curve { tip, dual_quaternion };
// Distance in the parameter between keyframes: the distance of their tips, or its square root (Lee 1989). The
// root swings less where long and short stretches meet, but does not run evenly along a straight line.
enum class Spacing { chord, centripetal };

struct KeyframeOptions {
    Interpolation interpolation = Interpolation::spline;
    Curve curve = Curve::tip;
    Spacing spacing = Spacing::chord;
    EndCondition ends = EndCondition::natural;
    std::size_t max_moves = 10'000'000;  // of keyframe_moves(); more are refused
};

// Where the tip stands still and only the axis turns, one radian counts as this chord, mm. It is small beside
// any stretch of path, so that turning on the spot hardly disturbs the path before and after.
inline constexpr double kChordPerRadian = 1.0;
// Returns the larger of the distance of the tips and the turn of the unit axes in that measure, mm.
double pose_chord(const ToolPose& a, const ToolPose& b);

// Largest number of keyframes of one spline: at 700 bytes each, and ten moves where it swings, it takes half
// a gigabyte. fit_motion() may use as many control points in all.
inline constexpr std::size_t kMostSplineKeyframes = 100'000;

struct KeyframeMotion {
    BSplineMotion motion;            // over 0..sum of chords; passes through every keyframe to rounding
    std::vector<double> parameters;  // of each keyframe, ascending; equal for a repeated pose
};

// Computes one C2 motion through all keyframes (options.interpolation is ignored). Refuses fewer than two
// poses, more than kMostSplineKeyframes, numbers that are not finite, an axis without direction, a weight <=
// 0, and keyframes between which the motion would have a pole (axes too far apart). The error names the line.
Result<KeyframeMotion> interpolate_keyframes(std::span<const Keyframe> keyframes,
                                             const KeyframeOptions& options = {});

// Returns the motion as moves: the spline cut into pieces within `tolerance`; (linear) straight moves from
// keyframe to keyframe; or (fit) fit_motion() with its own options, cut into pieces likewise: within 0.01 mm
// and 0.05 degrees of each keyframe, exact at corners and ends, without weights. Each move has the line of
// the keyframe at its end, and the feed of that keyframe, or `feed_mm_per_min` if it gives none. Repeated
// poses make no move. Refuses what interpolate_keyframes() refuses, and too many moves.
Result<std::vector<Move>> keyframe_moves(std::span<const Keyframe> keyframes, double feed_mm_per_min,
                                         const KeyframeOptions& options = {},
                                         const PieceTolerance& tolerance = {});

}  // namespace tribo::motion
