// SPDX-License-Identifier: MIT
// A program written anew as plain G-code: a block for each move, without variables, loops, calls, cycles,
// offsets and compensation.
#pragma once

#include <limits>
#include <string>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::readers {

struct UnrollOptions {
    GcodeDialect dialect = GcodeDialect::linuxcnc;
    double longest_mm = std::numeric_limits<double>::infinity();  // longer straight feed moves are divided
};

// In mm, with all digits: read again it gives the same moves; the centres of arcs agree to rounding. Feeds in
// mm/min, also of moves whose time the program gives. Refuses, with the line: tilted tools, curves that are
// no arcs about an axis, and more than a turn where the dialect has no word for it.
Result<std::string> unrolled_gcode(const motion::Program& program, const UnrollOptions& options);

}  // namespace tribo::readers
