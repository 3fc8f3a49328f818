// SPDX-License-Identifier: MIT
// The words of calls: M97 P L, M98 P L, M99 P, and G65 P L with its arguments.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/flow.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Runs the M97, M98 or M99 of the block. Returns false at the end of the program.
Result<bool> call_or_return(Command& command, Flow& flow, Output& output);

// Returns the G65 of the block; null if it has none.
const Word* macro_call_in(const Block& block);
// Runs the block of a G65: words behind it are arguments.
Result<void> call_macro(const Block& block, const Word& code, Flow& flow, const Output& output);

}  // namespace tribo::readers::gcode
