// SPDX-License-Identifier: MIT
// A program written anew in plain words of its language: a block for each move, without variables, loops,
// calls, cycles, offsets and compensation.
#pragma once

#include <limits>
#include <string>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/rewrite/feed_words.hpp"

namespace tribo::readers {

struct UnrollOptions {
    FeedLanguage language = FeedLanguage::gcode;                  // no APT
    GcodeDialect dialect = GcodeDialect::linuxcnc;                // of G-code
    double longest_mm = std::numeric_limits<double>::infinity();  // longer straight feed moves are divided
};

// In mm, with all digits: read again it gives the same moves; the centres of arcs agree to rounding. Feeds in
// mm/min, also of moves whose time the program gives. Refuses, with the line: tilted tools, curves that are
// no arcs about an axis (Heidenhain: about z), ways over a place that only the machine knows, and more than a
// turn where the dialect has no word for it.
Result<std::string> unrolled_program(const motion::Program& program, const UnrollOptions& options);

}  // namespace tribo::readers
