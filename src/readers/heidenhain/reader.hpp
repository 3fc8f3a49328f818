// SPDX-License-Identifier: MIT
// Heidenhain conversational programs (TNC, iTNC, TNC 640) to moves: L, C with CC, CR, CT, LP, CP, LN; Q
// parameters with formulas, FN functions and jumps, labels, repeats; BLK FORM, TOOL DEF and TOOL CALL; the
// drilling cycles 200 to 203, datum shift and rotation, PLANE SPATIAL; M128 and FUNCTION TCPM on a machine.
// Unknown content is refused with line and column. Any thread; allocates; time linear in the executed blocks.
#pragma once

#include <string_view>

#include "base/result.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::readers {

// Uses the options of G-code; block delete has no effect here. The unit is that of BEGIN PGM.
Result<motion::Program> read_heidenhain(std::string_view bytes, const GcodeOptions& options = {});
// The same, but moves go to the sink and not into the program.
Result<motion::Program> read_heidenhain(std::string_view bytes, const GcodeOptions& options, MoveSink& sink);

}  // namespace tribo::readers
