// SPDX-License-Identifier: MIT
// Axis words to moves: target, arc, feed and time of one block.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Moves the tip at rapid to the target of the axis words. Outputs a move if start and end are known.
Result<void> move_rapidly(Command& command, State& state, Output& output);

// Runs the motion of the block with the motion code in force.
Result<void> apply_motion(Command& command, State& state, Output& output);

// Seconds of a dwell P: it is written in seconds, on Fanuc controls in milliseconds. With a decimal point it
// is in seconds everywhere: Haas reads it so, and Fanuc's own controls allow no point.
double dwell_s(const Word& p, const Output& output);

// Adds a dwell at the position of the tip.
Result<void> dwell(double seconds, const Command& command, State& state, Output& output);

}  // namespace tribo::readers::gcode
