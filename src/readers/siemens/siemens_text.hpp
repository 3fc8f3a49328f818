// SPDX-License-Identifier: MIT
// Siemens 840D programs as G-code of the LinuxCNC kind: each line is rewritten, word for word and as far as
// it goes in its place, so that the messages of the G-code reader name the right line and column. X=10
// becomes X 10, CR= a radius, R parameters #, TRAORI and TRAFOOF tool tip control with A3 B3 C3 as tool
// vectors; what says nothing about the path (MSG, STOPRE, SOFT, CYCLE832 ...) is blanked out. What has no
// such form is refused. Any thread; allocates; linear.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::readers {

Result<std::string> siemens_to_gcode(std::string_view bytes, const std::string& source_name);

// The rewritten text read as G-code.
Result<motion::Program> read_siemens(std::string_view bytes, const GcodeOptions& options = {});
// The same, with the moves going to the sink and not into the program.
Result<motion::Program> read_siemens(std::string_view bytes, const GcodeOptions& options, MoveSink& sink);

}  // namespace tribo::readers
