// SPDX-License-Identifier: MIT
// The words of a block that set modes: units, plane, feed, spindle, tool, distances and active offsets.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// In the order of RS274/NGC 3.8, except that G20 and G21 count for the F word of their own block.
Result<void> apply_modes(Command& command, State& state, Output& output);

}  // namespace tribo::readers::gcode
