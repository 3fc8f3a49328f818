// SPDX-License-Identifier: MIT
// G-code to moves: lines, arcs and helices, units, planes, work offsets, feed modes and tool changes, modal
// words without G. What it does not know it refuses with line and column, it never guesses. The dialect is
// LinuxCNC's (RS274/NGC): a dwell's P is in seconds, '/' blocks are skipped, arc centres are incremental
// until G90.1. Any thread; allocates; time and memory linear in the bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "formats/length_unit.hpp"
#include "motion/program.hpp"

namespace tribo::formats {

inline constexpr std::string_view gcode_dialect = "LinuxCNC";

struct GcodeOptions {
    std::string source_name;                           // stands in messages
    LengthUnit default_unit = LengthUnit::millimetre;  // until the first G20 or G21, with a warning
    double default_feed_mm_per_min = 0;                // for feed moves before the first F; 0: refused
    bool skip_deletable_blocks = true;                 // blocks that start with '/'
    std::size_t max_moves = 10'000'000;                // more are refused: at 300 bytes each they take 3 GB
};

// The moves of a program, in the stock's frame: the work offsets that the program sets itself (G10 L2, G92)
// are applied, others are zero; the tool's length is not applied, as coordinates name its tip. The tool axis
// is +z. A block that does not move the tip gives no move, and so do rapids before X, Y and Z are all known.
// Rotary words (A B C) are noted in the program and otherwise left out. Arcs turn by `turn_rad` > 0; G2's
// have their normal turned over.
Result<motion::Program> read_gcode(std::string_view bytes, const GcodeOptions& options = {});

}  // namespace tribo::formats
