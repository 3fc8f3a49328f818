// SPDX-License-Identifier: MIT
// G150 of Haas: a pocket within a contour that a subprogram gives. Source: Haas mill operator's manual, G150.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/flow.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Moves above the start and calls the contour: lines from N, else the program O. Until it returns, its moves
// are kept. Refused: increments, planes other than G17, turned coordinates, a block without P, Z, Q, and I or
// J.
Result<void> begin_pocket(Command& command, State& state, Flow& flow, Output& output);
// Keeps a move of the contour. Refuses rapids and moves that leave the plane.
Result<void> keep_in_pocket(const motion::Move& move, State& state, const Output& output);
// Mills the pocket once its contour has returned. Refuses contours that are open or that the tool does not
// fit into.
Result<void> mill_pocket_of(State& state, const Flow& flow, Output& output);

}  // namespace tribo::readers::gcode
