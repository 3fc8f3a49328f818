// SPDX-License-Identifier: MIT
// U V W: axes of the machine beside X Y Z, such as the quill W of a boring mill. The tip stands at X + U, Y +
// V, Z + W.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// A word U V W of the block is not 0, or its axis does not stand at 0.
bool has_parallel_move(const Command& command, const State& state);

// Moves the axes U V W to the words of the block and returns how far that moves the tip. Refuses words of
// programs for lathes and hot wires, and words in turned, tilted and rolled coordinates.
Result<Vec3> move_parallel_axes(Command& command, State& state, Output& output);

// G92 with U V W: their present places get the values of the words.
Result<void> preset_parallel_axes(Command& command, State& state, Output& output);

// Sends the axes U V W of the block to their home, which is taken as their zero, and hides their words.
void home_parallel_axes(Command& command, State& state);

}  // namespace tribo::readers::gcode
