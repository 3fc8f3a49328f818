// SPDX-License-Identifier: MIT
// G-code to moves: an interpreter of the LinuxCNC (RS274/NGC) and Fanuc family. Lines, arcs, splines, canned
// cycles, cutter compensation, offsets, feed modes, tool changes; parameters, expressions, subroutines, loops
// and branches. What it does not know it refuses with line and column, it never guesses. '/' blocks are
// skipped, arc centres are incremental until G90.1. Any thread; allocates; time linear in the bytes, or in
// the blocks that loops run.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "motion/machine/machine.hpp"
#include "motion/path/program.hpp"
#include "readers/text/length_unit.hpp"

namespace tribo::readers {

// Whose control the program is for, where two read one word differently: G4 P counts seconds in LinuxCNC and
// milliseconds on a Fanuc control, G76 is a lathe's thread here and fine boring there, G5.1 a spline here and
// look-ahead there.
enum class GcodeDialect { linuxcnc, fanuc };

constexpr std::string_view name_of(GcodeDialect dialect) {
    return dialect == GcodeDialect::fanuc ? "Fanuc" : "LinuxCNC";
}

// What cutter compensation and machines that turn their heads need to know of a tool.
struct GcodeTool {
    int number = 0;
    double diameter_mm = 0;
    std::optional<double> length_mm{};  // from the spindle nose to the tip
};

struct GcodeOptions {
    std::string source_name;  // stands in messages
    GcodeDialect dialect = GcodeDialect::linuxcnc;
    LengthUnit default_unit = LengthUnit::millimetre;  // until the first G20 or G21, with a warning
    double default_feed_mm_per_min = 0;                // for feed moves before the first F; 0: refused
    bool skip_deletable_blocks = true;                 // blocks that start with '/'
    std::vector<GcodeTool> tools;                      // for G41 and G42; they win over the program's own
    const motion::Machine* machine = nullptr;          // for rotary words; motion::check accepts it
    std::size_t max_moves = 10'000'000;                // more are refused: at 300 bytes each they take 3 GB
    std::size_t max_steps = 20'000'000;  // blocks that loops and calls may run before they count as endless
};

// Takes the moves of a program as they are read, so that a long one need not be held whole.
class MoveSink {
  public:
    virtual ~MoveSink() = default;
    virtual void take(const motion::Move& move) = 0;
};

// The moves of a program, in the stock's frame: the work offsets that the program sets itself (G10 L2, G92)
// are applied, others are zero; the tool's length is not applied, as coordinates name its tip. The tool axis
// is +z. A block that does not move the tip gives no move, and so do rapids before X, Y and Z are all known.
// Rotary words (A B C) need a machine: with one every move is what the tip does in the stock, with tool tip
// control (G43.4, M428 ...) or without; else they are noted in the program and left out. Arcs turn by
// `turn_rad` > 0; G2's have their normal turned over.
Result<motion::Program> read_gcode(std::string_view bytes, const GcodeOptions& options = {});

// The same, with the moves going to the sink and not into the program. Memory does not grow with the bytes
// but for splines, warnings and O-words; max_moves counts all the same.
Result<motion::Program> read_gcode(std::string_view bytes, const GcodeOptions& options, MoveSink& sink);

}  // namespace tribo::readers
