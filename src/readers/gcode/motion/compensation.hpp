// SPDX-License-Identifier: MIT
// Cutter radius compensation, G40 to G42.1: the programmed contour is followed by the edge of the cutter
// (RS274/NGC 3.5.10 and appendix B, with LinuxCNC's entry). The first move leads to the offset point at its
// end; round an outside corner the centre turns about it, at an inside corner two moves are cut off where
// they meet. What cannot be cut without gouging is refused.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// G40: what waits goes out. The tool stays on the offset contour until the next move leads it away.
Result<void> end_compensation(State& state, Output& output);

// Refuses what a block may not do while compensation is on; ends it where the block has G40.
Result<void> check_compensation(const Command& command, State& state, Output& output);

// G41, G42, G41.1 and G42.1 of the block, with their tool's diameter.
Result<void> begin_compensation(Command& command, State& state, Output& output);

// Hands out the first move after G40, which starts where the tool is.
Result<void> leave_compensation(motion::Move move, State& state, Output& output);

// Takes a programmed move while compensation is on. It goes out when the next one has shown where it ends.
Result<void> compensate(const motion::Move& programmed, State& state, Output& output);

}  // namespace tribo::readers::gcode
