// SPDX-License-Identifier: MIT
// G7.1, G107: cylindrical interpolation (Fanuc). Lines and arcs of one straight and one rotary axis, as in a
// plane rolled about a cylinder; the word of the rotary axis in G7.1 is its radius.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// G7.1 with A, B or C: its value begins it, 0 ends it. Takes the word away from the motion.
Result<void> switch_cylinder(Command& command, State& state, Output& output);

// Moves the tip at feed to the target while the rotary axis turns to RotaryState::target_rad.
Result<void> feed_on_cylinder(Command& command, State& state, Vec3 target, Output& output);

}  // namespace tribo::readers::gcode
