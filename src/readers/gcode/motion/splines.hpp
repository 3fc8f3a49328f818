// SPDX-License-Identifier: MIT
// Splines: G5 (cubic) and G5.1 (quadratic) as Bezier curves, G5.2 with G5.3 and G6.2 as rational B-splines.
// A quadratic curve is one exact move; the others become moves within motion::PieceTolerance.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// G5 and G5.1: one curve, whose block names its end and control points.
Result<void> run_bezier(Command& command, State& state, Output& output);

// G5.2 and G6.2: takes the control point, weight and knot of a block.
Result<void> add_to_nurbs(Command& command, State& state, Output& output);

// Ends the B-spline that runs: at G5.3, or where a G6.2 gives way to another block of motion. Nothing is done
// where none runs.
Result<void> finish_nurbs(State& state, Output& output);

// What a block means for a B-spline that runs: it ends it (G6.2 before another motion) or is refused (G5.2).
Result<void> close_nurbs_before(const Command& command, State& state, Output& output);

}  // namespace tribo::readers::gcode
