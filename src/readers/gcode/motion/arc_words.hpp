// SPDX-License-Identifier: MIT
// The arc that the words X Y Z I J K R P of a block write.
#pragma once

#include <optional>

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Returns the arc from the tip to the target; none if it is a point and moves nothing, or a straight line (a
// Fanuc control without centre and radius). Centres count from the
// start of the arc, or after G90.1 from the zero of the program. A program that states neither is read by its
// first arc that fits only one of them; if that is the absolute one, a warning says so. After G74 beside a
// motion arcs stay within a quadrant and their centres may lack signs (EIA RS-274-D).
Result<std::optional<motion::Arc>> arc_of(Command& command, State& state, Vec3 target, Output& output);

}  // namespace tribo::readers::gcode
