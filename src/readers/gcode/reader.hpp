// SPDX-License-Identifier: MIT
// G-code to moves: an interpreter of the LinuxCNC (RS274/NGC) and Fanuc family. It reads lines, arcs,
// splines, canned cycles, cutter compensation, offsets, feed modes, tool changes; parameters, expressions,
// subroutines, loops and branches. What leaves the path as it is and is not known is passed over with a
// warning; what may change the path and is not known is refused with line and column. Blocks with '/' are
// skipped; arc centres are incremental until G90.1, or until an arc fits only an absolute one. Any thread;
// allocates; time linear in the bytes, or in the blocks that loops run, which are limited.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "motion/machine/machine.hpp"
#include "motion/path/program.hpp"
#include "readers/control/refusals.hpp"
#include "readers/text/length_unit.hpp"
#include "readers/text/move_limit.hpp"

namespace tribo::readers {

// The control of the program; it matters where two controls read one word differently. G4 P counts seconds in
// LinuxCNC and milliseconds on a Fanuc control. G76 is fine boring on a Fanuc control and a thread of a lathe
// in LinuxCNC. G5.1 is look-ahead on a Fanuc control and a spline in LinuxCNC.
enum class GcodeDialect { linuxcnc, fanuc };

constexpr std::string_view name_of(GcodeDialect dialect) {
    return dialect == GcodeDialect::fanuc ? "Fanuc" : "LinuxCNC";
}

// Data of a tool for cutter compensation, for feeds per tooth and for machines with rotary axes in the head.
struct GcodeTool {
    int number = 0;  // 0: every tool that has no other entry
    double diameter_mm = 0;
    std::optional<double> length_mm{};  // from the spindle nose to the tip
    int flutes = 0;                     // for feeds per tooth; 0: not known
};

struct GcodeOptions {
    std::string source_name;  // used in messages
    GcodeDialect dialect = GcodeDialect::linuxcnc;
    LengthUnit default_unit = LengthUnit::millimetre;  // until the first G20 or G21, with a warning
    double default_feed_mm_per_min = 0;        // for feed moves before the first F; 0: they are refused
    bool skip_deletable_blocks = true;         // blocks with a leading '/'
    std::vector<GcodeTool> tools;              // they override the tools of the program
    const motion::Machine* machine = nullptr;  // for rotary words; motion::check accepts it
    // Receives all refusals of the program, each cause once, up to kMostRefusals: refused blocks are left out
    // then, and the first refusal is the result. Null: reading ends at the first.
    std::vector<Error>* refusals = nullptr;
    // Receives the names of the programs that are called and not in the text. They are left out then.
    std::vector<std::string>* missing_programs = nullptr;
    std::size_t max_moves = kMostMoves;  // more are refused
    // Loops and calls that run longer count as endless (control/run_limit.hpp).
    std::size_t max_steps = 20'000'000;  // blocks
    double max_loop_s = 3;
    std::function<double()> clock_s{};  // processor time from any start, for max_loop_s; absent: no clock
};

// Receives the moves of a program while they are read, so that a long program need not be held in memory.
class MoveSink {
  public:
    virtual ~MoveSink() = default;
    virtual void take(const motion::Move& move) = 0;
};

// Returns the moves of a program in the frame of the stock. The work offsets that the program sets itself
// (G10 L2, G92) are applied, other offsets are zero. Tool length is not applied: coordinates are those of the
// tip. The tool axis is +z. A block that does not move the tip gives no move; rapids before X, Y and Z are
// all known give none either. Rotary words (A B C) need a machine: with one, each move is the motion of the
// tip in the stock, with or without tool tip control (G43.4, M428 ...). Without a machine rotary words are
// recorded in the program and not applied. Arcs turn by `turn_rad` > 0; the normal of a G2 is reversed.
Result<motion::Program> read_gcode(std::string_view bytes, const GcodeOptions& options = {});

// The same, but moves go to the sink and not into the program. Memory does not grow with the bytes, except
// for splines, warnings and O-words. max_moves still counts.
Result<motion::Program> read_gcode(std::string_view bytes, const GcodeOptions& options, MoveSink& sink);

}  // namespace tribo::readers
