// SPDX-License-Identifier: MIT
// Converts motions to moves, and moves to the elementary moves of the cutting computation. Any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/curve/bspline_motion.hpp"
#include "motion/path/program.hpp"

namespace tribo::motion {

// Largest deviation of a piece from its motion, at the same parameter. A point of the tool at height h above
// the tip then deviates by at most tip_mm + h axis_rad: 0.2 um at 40 mm.
struct PieceTolerance {
    double tip_mm = 1e-4;
    double axis_rad = 2.5e-6;
};

// No quadratic piece turns the axis by more than this, whatever the tolerance.
inline constexpr double kMaxPieceTurnRad = 0.5235987755982988;
// No piece that turns is longer than this: up to here the nearest instant of a sweep is found reliably.
inline constexpr double kMaxTurningPieceMm = 10;

// Appends the part of the motion from parameter u0 to u1 > u0 as moves that join end to start, each with the
// words (kind, feed, line, ...) of `like`. Straight pieces with one axis become plain straight moves, and
// neighbours in one line are merged. All others become quadratic pieces. The exact control points of tip path
// and axis decide this. Returns false if they are more than `most`; some are then appended.
bool append_moves(const BSplineMotion& motion, double u0, double u1, const Move& like,
                  const PieceTolerance& tolerance, std::size_t most, std::vector<Move>& moves);

// Returns one move as pieces of the four kinds that have sweeps: straight with one axis, arc of at most a
// quarter turn about a line parallel to the axis without rise, quadratic, dwell. Times are divided in
// proportion to path; feeds stay. Helices, arcs about another line and turning axes become quadratics within
// the tolerance (a helix as a curve: its pieces join without corners). A straight rapid stays whole.
std::vector<Move> to_elementary(const Move& move, const PieceTolerance& tolerance = {});
// Returns their number without making them: a helix of ten thousand turns has millions.
std::size_t count_elementary(const Move& move, const PieceTolerance& tolerance = {});

}  // namespace tribo::motion
