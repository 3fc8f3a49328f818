// SPDX-License-Identifier: MIT
// Heidenhain conversational programs (TNC, iTNC, TNC 640) to moves: lines and circles in every plane, radius
// compensation, RND, CHF, APPR and DEP, LN; parameters with formulas, FN functions and jumps, labels,
// repeats; BLK FORM, tools by number and name; drilling, tapping and bore milling cycles, patterns of points;
// shift, rotation, mirror, scale, tilted planes; M128 and FUNCTION TCPM on a machine. docs/machines.md has
// every word. What may change the path and is not understood is refused with line and column, other words are
// passed over with a warning. Any thread; allocates; time linear in the executed blocks.
#pragma once

#include <string_view>

#include "base/result.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::readers {

// Uses the options of G-code. The unit is that of BEGIN PGM.
Result<motion::Program> read_heidenhain(std::string_view bytes, const GcodeOptions& options = {});
// The same, but moves go to the sink and not into the program.
Result<motion::Program> read_heidenhain(std::string_view bytes, const GcodeOptions& options, MoveSink& sink);

}  // namespace tribo::readers
