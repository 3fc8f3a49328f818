// SPDX-License-Identifier: MIT
// The tip path of one move as a curve: direction, arc length, curvature. A move's parameter t runs from 0 to
// 1, as in pose_at. No allocation except for pieces; any thread.
#pragma once

#include <vector>

#include "motion/path/program.hpp"

namespace tribo::motion {

// Derivative of the tip by t, mm. Zero for a dwell and for a turn on the spot.
Vec3 tip_derivative_mm(const Move& move, double t);

// Returns the true length of the tip path from t = 0 to t, mm. Closed form for every kind of move.
double path_length_mm(const Move& move, double t);

// Returns the t at which the tip has run `length` mm (clamped to the path). Straight moves and arcs: exact;
// quadratic: to 1e-12 of the path. A path without length gives 0.
double parameter_at_length(const Move& move, double length_mm);

// Returns the largest curvature of the tip path, 1/mm; infinity at a cusp (a quadratic that turns back on
// itself).
double max_curvature_per_mm(const Move& move);

// Returns the angle that the axis sweeps between start and end, rad; for a quadratic through its middle.
double axis_turn_rad(const Move& move);

// Returns the move from its start to t, 0 < t <= 1: the same path, cut off, with its share of the duration.
Move first_part(const Move& move, double t);
// Returns the move from t, 0 <= t < 1, to its end.
Move last_part(const Move& move, double t);

// Returns the move in pieces of about equal length, at most `longest_mm` > 0 each, that join end to start.
std::vector<Move> in_pieces(const Move& move, double longest_mm);

}  // namespace tribo::motion
