// SPDX-License-Identifier: MIT
// Canned cycles as rapids, feed moves and dwells: G73, G74, G76 (Fanuc), G81 to G86, G88, G89 along the axis
// normal to the plane, with G98 and G99, increments and repeats (RS274/NGC 3.5.16; LinuxCNC's paths).
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Whether the block starts or repeats the cycle that is in force.
bool repeats_cycle(const Command& command, const State& state);

// Puts the cycle of that code in force. After other motions the words of earlier cycles are forgotten, and
// G98 returns to where the tip is now.
void begin_cycle(Code code, State& state);

// Runs the cycle in force at the places that the block names.
Result<void> run_cycle(Command& command, State& state, Output& output);

}  // namespace tribo::readers::gcode
