// SPDX-License-Identifier: MIT
// Heidenhain conversational programs (TNC, iTNC, TNC 640) to moves: L, C with CC, CR, CT, LP, CP, LN; Q
// parameters with formulas, FN functions and jumps, labels, repeats; BLK FORM, TOOL DEF and TOOL CALL; the
// drilling cycles 200 to 203, datum shift and rotation, PLANE SPATIAL; M128 and FUNCTION TCPM on a machine.
// What it does not know it refuses with line and column. Any thread; allocates; time linear in the blocks
// that run.
#pragma once

#include <string_view>

#include "base/result.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::readers {

// Takes the options of G-code, of which block delete has no meaning here. The unit stands in BEGIN PGM.
Result<motion::Program> read_heidenhain(std::string_view bytes, const GcodeOptions& options = {});
// The same, with the moves going to the sink and not into the program.
Result<motion::Program> read_heidenhain(std::string_view bytes, const GcodeOptions& options, MoveSink& sink);

}  // namespace tribo::readers
