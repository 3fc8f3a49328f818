// SPDX-License-Identifier: MIT
// APT CLDATA to moves: GOTO with and without a tool axis, circles, cycles, frames, feeds, rapids, spindle,
// tools and units, in the spellings of NX, CATIA, Creo and others. Unknown statements are refused with line
// and column; the reader never guesses. Any thread; allocates; time and memory linear in the bytes and the
// moves.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/text/length_unit.hpp"
#include "readers/text/move_limit.hpp"

namespace tribo::readers {

struct AptOptions {
    std::string source_name;                           // used in messages
    LengthUnit default_unit = LengthUnit::millimetre;  // without a UNITS statement, with a warning
    double default_feed_mm_per_min = 0;                // for feed moves before the first FEDRAT; 0: refused
    std::size_t max_moves = kMostMoves;                // more are refused
    std::size_t max_statements = 1'000'000;            // run by macros, copies and loops; more are refused
    // Receives all refusals of the program (control/refusals.hpp). Null: reading ends at the first.
    std::vector<Error>* refusals = nullptr;
};

// Returns the moves of a program in the frame of its points; with several MSYS, in the frame of the first
// one. Rules:
// - A GOTO without an axis keeps the axis before it; MULTAX/OFF makes the axis vertical.
// - RAPID holds for the next GOTO only, and not if a FEDRAT comes before that GOTO.
// - The first point is a start, not a move. Repeated points make no moves.
// - CIRCLE and MOVARC hold for the next GOTO, and for the GOTOs directly after it whose points lie on the
//   same circle. An end equal to the start makes a full turn.
// - In a CYCLE each GOTO makes a hole.
// - After GOHOME without a point the position is unknown, and the next GOTO is a start again.
// Line numbers are those of the word of the statement.
Result<motion::Program> read_apt(std::string_view bytes, const AptOptions& options = {});

}  // namespace tribo::readers
