// SPDX-License-Identifier: MIT
// G12 and G13: a round pocket about the tool's place, clockwise and counter-clockwise, by the radius I, or by
// circles from I on, at steps of Q, up to K (Haas, Mill Operator's Manual).
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

Result<void> mill_round_pocket(Command& command, State& state, Output& output, Code code);

}  // namespace tribo::readers::gcode
