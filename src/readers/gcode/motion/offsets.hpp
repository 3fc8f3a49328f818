// SPDX-License-Identifier: MIT
// The codes that act in their own block only: dwell (G4), offsets (G10, G52, G92 and its kin), home (G28,
// G30).
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// True where such a code has used the axis words of the block: no motion is left to do. G53 is left to the
// motion.
Result<bool> apply_non_modal(Command& command, State& state, Output& output);

}  // namespace tribo::readers::gcode
