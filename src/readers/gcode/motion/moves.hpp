// SPDX-License-Identifier: MIT
// What every kind of motion is made with: targets, starting points, feeds, and moves that go out.
#pragma once

#include <string_view>

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Column of the first of these words in the block; 1 where it has none.
int column_of_any(Command& command, std::string_view letters);

std::unexpected<Error> refuse_far(Command& command, char letter, const Output& output);

// The coordinate word of an axis (0 x, 1 y, 2 z) in mm, if the block has it; refused beyond a kilometre.
Result<std::optional<double>> coordinate_mm(Command& command, int axis, const State& state, Output& output);

// A move that starts and ends at the tip, with the words that all moves share.
motion::Move new_move(motion::MoveKind kind, const Command& command, const State& state);

struct Target {
    Vec3 tip_mm;
    std::array<Known, 3> known;
};
// Where the axis words lead. In G91 an axis that nothing has stated is taken to start at the program's zero.
Result<Target> target_of(Command& command, State& state, Output& output);

// A feed move needs to know where it starts.
Result<void> require_start(Command& command, State& state, Output& output);

// Sets feed and time of a feed move whose path is complete.
Result<void> set_feed(motion::Move& move, Command& command, const State& state, Output& output);

// Warnings that a feed move may be worth.
void note_spindle(const Command& command, const State& state, Output& output);

// Hands out a move in the frame of the program's axes, as it is.
Result<void> hand_out(const motion::Move& move, State& state, Output& output);

// Hands out a move in the frame of the program's axes, cutter compensation applied.
Result<void> append(const motion::Move& move, State& state, Output& output);

// A straight move of the tip, known, to a place in the same frame; none where it is there.
Result<void> append_straight(motion::MoveKind kind, Vec3 to_mm, Command& command, State& state,
                             Output& output);

}  // namespace tribo::readers::gcode
