// SPDX-License-Identifier: MIT
// Rotary words and tool tip control on a machine: what A, B, C and G43.4, M128 or M428 make of a block.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Tool tip control on or off as the block's G43.4, G49, M428 ... say. Tip and axis stay where they are, the
// coordinates change their meaning.
Result<void> switch_tip_control(const Command& command, State& state, Output& output);

// The block's words A B C (with G43.5 of a line also I J K) as targets of the rotary axes; without a machine
// they are noted only.
Result<void> read_rotary_words(Command& command, State& state, Output& output);

// The move with the tool's axis from where it is to where the block's vector has it, which it then is.
motion::Move with_vectors(const motion::Move& move, State& state);

// The time of a feed move that turns rotary axes, from the feed that it has: along X Y Z the feed is the
// path's, on the spot it counts degrees (RS274/NGC 2.1.2.5). Moves that keep their axes are left alone.
void set_turning_time(motion::Move& move, const State& state);

// The move, in coordinates as the program writes them, as moves of the tip in the stock; the rotary axes
// arrive at their targets.
Result<void> append_on_machine(const motion::Move& move, State& state, Output& output);

}  // namespace tribo::readers::gcode
