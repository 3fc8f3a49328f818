// SPDX-License-Identifier: MIT
// What a block holds that does not change the path: it is passed over with a warning. What could change the
// path is refused.
#pragma once

#include "readers/gcode/command.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Warns of the comments and of the part behind '/' that other controls read otherwise.
void note_writing(const Block& block, Output& output);

// Warns of M codes that only the machine knows; their words count as used.
void pass_unknown_codes(Command& command, Output& output);

// Passes over the words that nothing in the block has used: D E H L P Q, and others of value 0. Refuses the
// rest. On a Fanuc control D holds for the compensation that comes.
Result<void> pass_unused_words(Command& command, State& state, Output& output);

// Passes over a block that tells MANUAL GUIDE i what to draw (G1900 to G1999, Fanuc): true if it is one. A
// box (G1902) with its top at 0 is the stock.
bool pass_drawing_data(const Block& block, const State& state, Output& output);

// Passes over a line that begins with '$'; after $H only the machine knows where the tool is.
void pass_setting(const Block& block, State& state, Output& output);

// Warns of a Fanuc program without any point in its coordinates and with large ones: the control may count
// them in thousandths.
void note_least_increments(const State& state, Output& output);

// Warns of a program that looks as if it were for a lathe.
void note_lathe(const State& state, Output& output);

}  // namespace tribo::readers::gcode
