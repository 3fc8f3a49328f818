// SPDX-License-Identifier: MIT
// The words of calls: M97 P L (Q: to that line), M98 P L, M99 P, and G65 P L and G66 P L with their
// arguments.
#pragma once

#include <cstdint>

#include "readers/gcode/command.hpp"
#include "readers/gcode/flow.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Runs the M97, M98 or M99 of the block. Returns false at the end of the program.
Result<bool> call_or_return(Command& command, State& state, Flow& flow, Output& output);

// A call with variables of its own.
struct MacroCall {
    Word number;       // of the program
    std::string name;  // G65<NAME>; empty: by its number
    std::int64_t times = 1;
    Flow::Arguments arguments{};
};

// Reads the block of a G65 or G66: words behind it are arguments.
Result<MacroCall> read_macro_call(const Block& block, const Word& code, const Output& output);
Result<void> call_macro(const MacroCall& call, int line, State& state, Flow& flow, Output& output);

}  // namespace tribo::readers::gcode
