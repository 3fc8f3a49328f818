// SPDX-License-Identifier: MIT
// Cutter radius compensation, G40 to G42.1: the edge of the cutter follows the programmed contour (RS274/NGC
// 3.5.10 and appendix B, with the entry move of LinuxCNC). The first move leads to the offset point at its
// end. At an outside corner the centre turns about the corner; at an inside corner both moves are shortened
// to their intersection; in the Fanuc dialect a straight first move then leads square to the start of the
// second one (entry move of Allen-Bradley's 9/Series, 8520-MUM, chapter 21, whose codes are Fanuc's). A
// contour that cannot be cut without gouging is refused.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// G40: outputs the waiting moves. The tool stays on the offset contour until the next move.
Result<void> end_compensation(State& state, Output& output);

// Refuses the codes that are not allowed while compensation is on. Ends compensation if the block has G40.
Result<void> check_compensation(Command& command, State& state, Output& output);

// G41, G42, G41.1 and G42.1 of the block, with the diameter of their tool.
Result<void> begin_compensation(Command& command, State& state, Output& output);

// Outputs the first move after G40. It starts at the current position of the tool.
Result<void> leave_compensation(motion::Move move, State& state, Output& output);

// Takes a programmed move while compensation is on. The move is output when the next one has determined its
// end.
Result<void> compensate(const motion::Move& programmed, State& state, Output& output);

}  // namespace tribo::readers::gcode
