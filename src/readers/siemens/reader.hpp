// SPDX-License-Identifier: MIT
// Siemens programs (Sinumerik 840D and its kin) to moves: the language of its programming manuals with
// variables, structures, jumps, subprograms and their parameters; frames, swivelled planes, tool vectors;
// circles of all kinds, splines, corners, radius compensation; drilling, pattern and milling cycles.
// docs/machines.md has every word. What may change the path and is not understood is refused with line and
// column, other words are passed over with a warning. Any thread; allocates; time linear in the executed
// blocks.
#pragma once

#include <string_view>

#include "base/result.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::readers {

// Uses the options of G-code.
Result<motion::Program> read_siemens(std::string_view bytes, const GcodeOptions& options = {});
// The same, but moves go to the sink and not into the program.
Result<motion::Program> read_siemens(std::string_view bytes, const GcodeOptions& options, MoveSink& sink);

}  // namespace tribo::readers
