// SPDX-License-Identifier: MIT
// @ and ^ of LinuxCNC: the radius and the angle of the target about the zero of X and Y. In G91 both are
// added to those of the tip. LinuxCNC, G-code overview, polar coordinates.
#pragma once

#include "readers/gcode/state.hpp"
#include "readers/gcode/text/lexer.hpp"

namespace tribo::readers::gcode {

// Adds X and Y to the words of a block with @ or ^. Leaves other blocks as they are.
Result<void> place_polar_words(Block& block, const State& state, const Output& output);

}  // namespace tribo::readers::gcode
