// SPDX-License-Identifier: MIT
// APT CLDATA to moves: GOTO with and without a tool axis, circles, cycles, frames, feeds, rapids, spindle,
// tools and units, in the spellings of NX, CATIA, Creo and others. What it does not know it refuses with line
// and column, it never guesses. Any thread; allocates; time and memory linear in the bytes and the moves.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/text/length_unit.hpp"

namespace tribo::readers {

struct AptOptions {
    std::string source_name;                           // stands in messages
    LengthUnit default_unit = LengthUnit::millimetre;  // where no UNITS statement says, with a warning
    double default_feed_mm_per_min = 0;                // for feed moves before the first FEDRAT; 0: refused
    std::size_t max_moves = 10'000'000;                // more are refused: at 300 bytes each they take 3 GB
};

// The moves of a program, in the frame in which it gives its points; that of the first MSYS where it has
// several. A GOTO without an axis keeps the one before; MULTAX/OFF sets it upright. RAPID counts for the next
// GOTO alone, and not if a FEDRAT comes before it. The first point is a start, not a move. Repeated points
// make no moves. CIRCLE and MOVARC hold for the next GOTO and for those that follow it at once and lie on the
// circle as well; an end that is the start makes a full turn. In a CYCLE each GOTO makes a hole. After GOHOME
// without a point nobody knows where the tool is: the next GOTO is a start again. Line numbers are those of
// the statement's word.
Result<motion::Program> read_apt(std::string_view bytes, const AptOptions& options = {});

}  // namespace tribo::readers
