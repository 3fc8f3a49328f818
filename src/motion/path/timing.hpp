// SPDX-License-Identifier: MIT
// The time law of a list of moves: position of the machine at each time. Linear in the number of moves; any
// thread.
//
// A feed move runs its tip at its feed, or takes the duration that the program gives (inverse time). A rapid
// runs at the machine's rate. A dwell has its duration. If the axis would turn faster than its limit, the
// move takes the time of the turn; so a turn on the spot has a time too. With an acceleration limit the speed
// along the tip path is a chain of trapezoids, with look-ahead over the whole list:
// - at a corner of angle c between two moves, v^2 <= a R with R = d cos(c/2) / (1 - cos(c/2)): the circle of
//   radius R touches both moves and passes the corner at the distance d (junction deviation);
// - exact stop at corners beyond `stop_rad`, between rapid and feed, and at dwells and turns on the spot;
// - v^2 <= a / curvature on arcs and quadratics; a cusp counts as curvature 1/d.
// The turning of the axis has no acceleration limit of its own.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/path/program.hpp"

namespace tribo::motion {

struct TimingOptions {
    double rapid_mm_per_min = 10000;
    double acceleration_mm_per_s2 = 0;               // along and across the path; 0: speeds change at once
    double max_axis_rad_per_s = 1.5707963267948966;  // 15 turns per minute, a common rotary table
    double corner_deviation_mm = 0.01;
    double stop_rad = 1.0471975511965976;  // 60 degrees
};

// One move in time: the speed rises from entry to peak, stays, falls to exit. Speeds in mm/s along the tip
// path. A move without path (dwell, turn on the spot) has speed 0 and runs evenly.
struct MoveTiming {
    double start_s = 0, end_s = 0;
    double length_mm = 0;
    double entry_mm_per_s = 0, peak_mm_per_s = 0, exit_mm_per_s = 0;
    double rise_s = 0, fall_s = 0;  // parts of end_s - start_s

    // Returns the fraction of the tip path that is finished at the time, 0..1, clamped to the move.
    double path_fraction(double time_s) const;
    // Returns the time at which that fraction of the tip path is finished: the inverse of path_fraction.
    double time_at_s(double path_fraction) const;
    double speed_mm_per_s(double time_s) const;
};

struct Schedule {
    std::vector<MoveTiming> moves;  // one per move; each starts when the one before ends
    double duration_s = 0;
    double feed_s = 0;  // part of duration_s in feed moves

    // Returns the current move at the time (the later one at a joint), clamped. Needs at least one move.
    std::size_t move_at(double time_s) const;
};

// Refuses a feed move without feed and duration, numbers that are not finite and options <= 0. The error
// names the line.
Result<Schedule> schedule(std::span<const Move> moves, const TimingOptions& options = {});

// Returns the pose at a time of the schedule of these moves.
ToolPose pose_at_time(std::span<const Move> moves, const Schedule& schedule, double time_s);

}  // namespace tribo::motion
