// SPDX-License-Identifier: MIT
// Splines: G5 (cubic) and G5.1 (quadratic) as Bezier curves, G5.2 with G5.3 and G6.2 as rational B-splines.
// A quadratic curve is one exact move; the others become moves within motion::PieceTolerance.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// G5 and G5.1: one curve. The block gives its end and control points.
Result<void> run_bezier(Command& command, State& state, Output& output);

// G5.2 and G6.2: adds the control point, weight and knot of a block.
Result<void> add_to_nurbs(Command& command, State& state, Output& output);

// Ends the running B-spline: at G5.3, or when another motion follows a G6.2. Does nothing if none runs.
Result<void> finish_nurbs(State& state, Output& output);

// Called before a block while a B-spline runs: ends it (G6.2 before another motion) or refuses the block
// (G5.2).
Result<void> close_nurbs_before(const Command& command, State& state, Output& output);

}  // namespace tribo::readers::gcode
