// SPDX-License-Identifier: MIT
// Tilted planes: coordinates in a plane that is turned in space (Fanuc G68.2, G68.3 and G68 about an axis in
// space; Haas G268), and the tool normal to it (G53.1, G53.6).
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// True if the code begins a tilted plane with these words.
bool begins_tilted_plane(const Command& command, Code rotation);
Result<void> begin_tilted_plane(Command& command, State& state, Output& output, Code rotation);
// G69, G269: back to the axes of the work system. The tool does not move.
void end_tilted_plane(State& state, Output& output, int line);
// G53.1, G53.6: turns the tool normal to the plane; without a plane nothing happens.
Result<void> turn_tool_to_plane(Command& command, State& state, Output& output, Code code);

// Returns a move in the axes of the program as one in the stock; the axis of the tool is left as it is.
motion::Move in_stock(const motion::Move& move, const State& state);

}  // namespace tribo::readers::gcode
