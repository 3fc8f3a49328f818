// SPDX-License-Identifier: MIT
// The motion through keyframes. Allocates its result; any thread.
//
// A cutter of revolution leaves the turn about its axis open; the frames take the turn that never twists
// (minimal_twist_displacements). Interpolating dual quaternions directly (Curve::dual_quaternion) is
// indifferent to the choice of frames, in the stock as in the tool, and so the tip swings off the line of its
// keyframes by about L t / 8 over a stretch of L mm in which the axis turns by t rad: what a screw does.
// The default (Curve::tip) keeps the tip on the path of its points: Q(u) = (w + e/2 P) q with P / w the
// rational cubic spline through the tips and q the cubic spline through the rotations, all C2. w
// has the weights as control points, so w > 0. That product is
// a spline of degree 6 in dual quaternion space whose knots (fourfold) say C2. Collinear tips with any axes
// stay collinear, equal axes stay equal. Sources: Juttler & Wagner 1996 (translation and rotation of a
// rational motion are free of each other); Ge & Ravani 1991.
#pragma once

#include <span>
#include <vector>

#include "motion/algebra/cubic_interpolation.hpp"
#include "motion/curve/bspline_motion.hpp"
#include "motion/curve/keyframe.hpp"
#include "motion/path/moves.hpp"

namespace tribo::motion {

// One motion through all keyframes; straight moves from one to the next; or smooth motions from corner to
// corner (fitting.hpp), for paths of many keyframes that have corners.
enum class Interpolation { spline, linear, fit };
enum class Curve { tip, dual_quaternion };
// Distance in the parameter between keyframes: of their tips, or its square root (Lee 1989), which swings
// less where long and short stretches meet but no longer runs evenly along a straight line.
enum class Spacing { chord, centripetal };

struct KeyframeOptions {
    Interpolation interpolation = Interpolation::spline;
    Curve curve = Curve::tip;
    Spacing spacing = Spacing::chord;
    EndCondition ends = EndCondition::natural;
};

// Where the tip stands still and only the axis turns, one radian counts as this much chord, mm: small beside
// any stretch of path, so that turning on the spot hardly disturbs the path before and after.
inline constexpr double kChordPerRadian = 1.0;
// The larger of the distance of the tips and the turn of the unit axes in that measure, mm.
double pose_chord(const ToolPose& a, const ToolPose& b);

struct KeyframeMotion {
    BSplineMotion motion;            // over 0..the summed chord; passes every keyframe to rounding
    std::vector<double> parameters;  // of each keyframe, ascending; equal ones for a repeated pose
};

// One C2 motion through all keyframes (options.interpolation is not looked at). Refuses fewer than two poses,
// numbers that are not finite, an axis without direction, a weight <= 0, and keyframes between which the
// motion would have a pole (axes too far apart), naming the line.
Result<KeyframeMotion> interpolate_keyframes(std::span<const Keyframe> keyframes,
                                             const KeyframeOptions& options = {});

// The same as moves: the spline cut into pieces within `tolerance`, (linear) straight moves from keyframe to
// keyframe, or (fit) fit_motion() with its own options, in pieces likewise: within 0.01 mm and 0.05 degrees
// of each keyframe, exact at corners and ends, and weights do not count. Each move has the line of the
// keyframe it runs to, and its feed, or `feed_mm_per_min` where the keyframe says none. Repeated poses make
// no move.
Result<std::vector<Move>> keyframe_moves(std::span<const Keyframe> keyframes, double feed_mm_per_min,
                                         const KeyframeOptions& options = {},
                                         const PieceTolerance& tolerance = {});

}  // namespace tribo::motion
