// SPDX-License-Identifier: MIT
// Axis words to moves: targets, arcs, feed and time of one block.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Where the words of the block take the tip at a rapid, and the move there if start and end are known.
Result<void> move_rapidly(Command& command, State& state, Output& output);

// The motion that the block asks for with the motion code in force.
Result<void> apply_motion(Command& command, State& state, Output& output);

// A stop of so many seconds where the tip stands.
Result<void> dwell(double seconds, const Command& command, State& state, Output& output);

}  // namespace tribo::readers::gcode
