// SPDX-License-Identifier: MIT
// The lines in brackets with which programs for Denford's mills (and the simulator FANUCM that schools use)
// state billet and tools: [BILLET X100 Y80 Z30, [EDGEMOVE X-10 Y-10, [TOOLDEF T1 D10 Z50.
#pragma once

#include "readers/gcode/state.hpp"
#include "readers/gcode/text/lexer.hpp"

namespace tribo::readers::gcode {

// Takes such a line: the size of the billet, the place of its corner, or a tool's diameter. Refuses other
// names.
Result<void> take_denford_line(const Block& block, State& state, Output& output);

// Makes the billet the stock of the program: its top at 0, its corner at 0 0 or where [EDGEMOVE put it. Call
// it at the end of the program, as these lines stand before the one that states the unit.
void declare_billet(const State& state, Output& output);

}  // namespace tribo::readers::gcode
