// SPDX-License-Identifier: MIT
// Siemens 840D programs as G-code of the LinuxCNC family. Each line is rewritten word for word and, as far as
// possible, at the same column, so that messages of the G-code reader have the right line and column. X=10
// becomes X 10, CR= a radius, R parameters become #, TRAORI and TRAFOOF become tool tip control with A3 B3 C3
// as tool vectors. Words without effect on the path (MSG, STOPRE, SOFT, CYCLE832 ...) are replaced by blanks.
// Words without an equivalent in G-code are refused. Any thread; allocates; linear time.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::readers {

Result<std::string> siemens_to_gcode(std::string_view bytes, const std::string& source_name);

// Rewrites the text and reads it as G-code.
Result<motion::Program> read_siemens(std::string_view bytes, const GcodeOptions& options = {});
// The same, but moves go to the sink and not into the program.
Result<motion::Program> read_siemens(std::string_view bytes, const GcodeOptions& options, MoveSink& sink);

}  // namespace tribo::readers
