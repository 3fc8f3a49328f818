// SPDX-License-Identifier: MIT
// Canned cycles as rapids, feed moves and dwells: G73, G74, G76 (Fanuc), G81 to G86, G88, G89 along the axis
// normal to the plane, with G98 and G99, increments and repeats (RS274/NGC 3.5.16; paths of LinuxCNC).
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// True when the block starts the cycle or repeats the cycle in force.
bool repeats_cycle(const Command& command, const State& state);

// Makes the cycle of that code the cycle in force. After other motions the words of earlier cycles are
// cleared, and G98 returns to the current level of the tip.
void begin_cycle(Code code, State& state);

// Runs the cycle in force at the positions of the block.
Result<void> run_cycle(Command& command, State& state, Output& output);

}  // namespace tribo::readers::gcode
