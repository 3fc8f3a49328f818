// SPDX-License-Identifier: MIT
// Rotary words and tool tip control on a machine: the effect of A, B, C and of G43.4, M128 or M428 on a
// block.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Switches tool tip control on or off by G43.4, G49, M428, ... of the block. Tip and axis stay; the meaning
// of the coordinates changes.
Result<void> switch_tip_control(const Command& command, State& state, Output& output);

// G254 and G54.2 P1: from now on the zero of the coordinates goes with the part as its axes turn; G255 and
// G54.2 P0 end that. Tip and axis stay.
void switch_turning_zero(Command& command, State& state, Output& output);

// Reads the words A B C of the block (with G43.5 of a line also I J K) as targets of the rotary axes. Without
// a machine they are only noted.
Result<void> read_rotary_words(Command& command, State& state, Output& output);

// Returns the move with the tool axis from its current direction to the vector of the block, and makes this
// vector the current direction.
motion::Move with_vectors(const motion::Move& move, State& state);

// Sets the time of a feed move that turns rotary axes, from its feed. On LinuxCNC the feed is that of the
// path where X Y Z move, else it counts degrees (RS274/NGC 2.1.2.5); Fanuc: control/rotary_feed.hpp. Moves
// without a turn are unchanged.
void set_turning_time(motion::Move& move, const State& state, Output& output);

// Outputs the move, given in coordinates as written in the program, as moves of the tip in the stock. The
// rotary axes are at their targets afterwards.
Result<void> append_on_machine(const motion::Move& move, State& state, Output& output);

}  // namespace tribo::readers::gcode
