// SPDX-License-Identifier: MIT
// From motions to the moves that cutting is computed on. Any thread.
#pragma once

#include <span>
#include <vector>

#include "motion/curve/bspline_motion.hpp"
#include "motion/path/program.hpp"

namespace tribo::motion {

// How far a piece may be off the motion it stands for, at the same parameter. A point of the tool at height h
// above the tip is then off by at most tip_mm + h axis_rad: 0.2 um at 40 mm.
struct PieceTolerance {
    double tip_mm = 1e-4;
    double axis_rad = 2.5e-6;
};

// No quadratic piece turns the axis by more than this, whatever the tolerance.
inline constexpr double kMaxPieceTurnRad = 0.5235987755982988;
// Nor is one longer than this while it turns: the nearest instant of a sweep is found for sure up to here.
inline constexpr double kMaxTurningPieceMm = 10;

// The whole motion as moves that join end to start, each with the words (kind, feed, line, ...) of `like`.
// Pieces that run straight with one axis become plain straight moves, neighbours in one line merged; all else
// becomes quadratic pieces. Both are told by the exact control points of tip path and axis.
std::vector<Move> to_moves(const BSplineMotion& motion, const Move& like,
                           const PieceTolerance& tolerance = {});

// Appends the moves of the motion's part from parameter u0 to u1 > u0, `pieces` being all its pieces.
void append_moves(std::span<const MotionPiece> pieces, double u0, double u1, const Move& like,
                  const PieceTolerance& tolerance, std::vector<Move>& moves);

// One move as pieces of the four kinds that sweeps are computed for: straight with one axis, arc of at most a
// quarter turn about a line parallel to the axis without rise, quadratic, dwell. Times and feeds are shared
// out in proportion to path. Helices, arcs about another line and turning axes become quadratics, within the
// tolerance (a helix as a curve: its pieces join without corners). A rapid stays whole where it is straight.
std::vector<Move> to_elementary(const Move& move, const PieceTolerance& tolerance = {});

}  // namespace tribo::motion
