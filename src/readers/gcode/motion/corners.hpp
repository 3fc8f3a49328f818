// SPDX-License-Identifier: MIT
// Corners that a block asks for at its end: ,R and ,C (Fanuc), G36 and G39 with R (Fagor). The move of the
// block waits for the next one in the plane; then an arc or a chamfer is put between them.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// The move seen along the axis of the plane.
Element element_of(const motion::Move& move, Plane plane);

// The corner that the block asks for, in mm; none if it has none.
Result<std::optional<CornerSize>> corner_of(Command& command, const State& state, const Output& output);

// Keeps a feed move in the plane until the next one is known.
Result<void> wait_for_corner(const motion::Move& move, CornerSize size, State& state, const Output& output);
// Ends the move that waits and begins `next` behind the corner: outputs both, and the corner between them. If
// `next` has a corner too, it waits in turn.
Result<void> join_at_corner(motion::Move next, State& state, Output& output,
                            const std::optional<CornerSize>& its_corner = {});
// Refuses a corner that no move in the plane follows.
Result<void> check_no_corner_waits(const State& state, const Output& output, int line);

}  // namespace tribo::readers::gcode
