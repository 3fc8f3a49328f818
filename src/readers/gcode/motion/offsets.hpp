// SPDX-License-Identifier: MIT
// The codes that act only in their own block: dwell (G4), offsets (G10, G52, G92, G92.1, ...), home (G28,
// G30).
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Returns true if such a code has used the axis words of the block: then no motion is left to run. G53 is
// left to the motion.
Result<bool> apply_non_modal(Command& command, State& state, Output& output);

}  // namespace tribo::readers::gcode
