// SPDX-License-Identifier: MIT
// Common parts of all motions: targets, starting points, feeds, and the output of moves.
#pragma once

#include <string_view>

#include "base/limits.hpp"
#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Returns the column of the first of these words in the block; 1 if it has none.
int column_of_any(Command& command, std::string_view letters);

// Refuses a value out of its range, at the word that gave it. `value` is in the unit of the limit.
Result<void> in_range(const Limit& limit, double value, const Command& command, const Word& word,
                      const Output& output);

// Returns the length of a word in mm, if the block has it. Refuses values out of range.
Result<std::optional<double>> length_mm(Command& command, char letter, State& state, Output& output);

// Returns the coordinate word of an axis (0 x, 1 y, 2 z) in mm, if the block has it. Refuses values out of
// range.
Result<std::optional<double>> coordinate_mm(Command& command, int axis, State& state, Output& output);

// Returns a move that starts and ends at the tip, with tool, spindle and line of the block.
motion::Move new_move(motion::MoveKind kind, const Command& command, const State& state);

// Fixes where the stock stands, at the first block with coordinates (State::stock_at_mm).
void place_stock(const Command& command, State& state, Output& output);

struct Target {
    Vec3 tip_mm;
    std::array<Known, 3> known;
};
// Returns the target of the axis words. In G91 an axis without a stated position starts at the zero of the
// program.
Result<Target> target_of(Command& command, State& state, Output& output);

// Refuses a feed move without a known start.
Result<void> require_start(Command& command, State& state, Output& output);

// Sets feed and time of a feed move with a complete path.
Result<void> set_feed(motion::Move& move, Command& command, const State& state, Output& output);

// Adds the warnings about the spindle for a feed move.
void note_spindle(const Command& command, const State& state, Output& output);

// Outputs a move in the frame of the axes of the program, unchanged.
Result<void> hand_out(const motion::Move& move, State& state, Output& output);

// Outputs a move in the frame of the axes of the program, with cutter compensation.
Result<void> append(const motion::Move& move, State& state, Output& output);

// Adds a straight move from the tip, which must be known, to a point in the same frame; no move if the tip is
// already there.
Result<void> append_straight(motion::MoveKind kind, Vec3 to_mm, Command& command, State& state,
                             Output& output);

}  // namespace tribo::readers::gcode
