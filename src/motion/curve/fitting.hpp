// SPDX-License-Identifier: MIT
// Fits few smooth motions to a stream of tool poses, for example from G1 blocks or GOTO lines. The motions
// are C2 between corners. They pass through the first and last pose of each run exactly, and within a
// tolerance of all others. The method is least squares, with knots added where the error is too large (Piegl
// & Tiller 1997, The NURBS Book, 9.4). If even a knot at every second pose is not enough, it is the C2
// interpolant through all poses of the run. O(n log n); allocates; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/curve/keyframe_motion.hpp"

namespace tribo::motion {

struct FitOptions {
    double position_tolerance_mm = 0.01;  // of the tip, at every pose
    double angle_tolerance_deg = 0.05;    // of the axis, at every pose
    // A pose is a corner, kept sharp, if the path of the tip or of a point 50 mm up the tool turns there by
    // more than this.
    double corner_deg = 20;
    Curve curve = Curve::tip;  // dual_quaternion: cubic instead of degree 6, but the tip swings between poses
};

struct FittedRun {
    BSplineMotion motion;
    std::size_t first = 0, last = 0;  // poses of the stream: from corner to corner
    std::vector<double> parameters;   // of these poses, ascending; equal for a repeated pose
};

struct MotionFit {
    std::vector<FittedRun> runs;
    double max_position_error_mm = 0;  // at the poses, over all runs
    double max_angle_error_rad = 0;
    // Distance of the curve half-way between poses from the chord between them. This is the sagitta of the
    // curve and no error by itself, but a value far above that of the poses shows a wiggle.
    double max_chord_deviation_mm = 0;
    std::size_t control_points = 0;
};

// Refuses fewer than two different poses, numbers that are not finite, axes without direction, tolerances <=
// 0 and poses that need more than kMostSplineKeyframes control points of cubics. Axes need not be unit.
Result<MotionFit> fit_motion(std::span<const ToolPose> poses, const FitOptions& options = {});

}  // namespace tribo::motion
