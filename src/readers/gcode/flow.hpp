// SPDX-License-Identifier: MIT
// Control flow: O-word subroutines, branches and loops of LinuxCNC, M98 and M99 of the Fanuc family. It
// decides which line the lexer reads next.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "readers/control/run_limit.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/gcode/text/labels.hpp"
#include "readers/gcode/text/lexer.hpp"
#include "readers/gcode/text/parameters.hpp"

namespace tribo::readers::gcode {

class Flow {
  public:
    // All arguments must outlive the object. `moves`: the number of moves so far.
    Flow(std::string_view bytes, const GcodeOptions& options, Lexer& lexer, Parameters& parameters,
         const std::size_t& moves);

    // Runs an o_word block that the lexer has just read. Returns true if the block is a program number at the
    // outermost level.
    Result<bool> run(Block& block);

    // M98: runs the program of that number, `times` times.
    Result<void> call_program(const Word& number, long times, int line);
    // M99. Returns false if no program has called this one.
    Result<bool> return_from_program(int line, int column);
    // At the end of the text. Refuses an open subroutine or loop.
    Result<void> end_text(int line) const;
    bool is_outermost() const { return calls_.empty(); }

    // Counts the block that the lexer has just read. Refuses a program that seems to run forever.
    Result<void> count_step(int line);

  private:
    // A call without its return so far.
    struct Call {
        TextLines back;           // the line after the call
        int callee = -1;          // landmark of the called program
        long times_left = 0;      // after this run
        std::size_t loops = 0;    // number of running loops at the call
        bool is_program = false;  // M98
    };
    // A running repeat loop.
    struct Repeat {
        int opener = -1;
        long left = 0;
    };

    Result<void> require_labels();
    Result<void> branch(int index, Block& block);
    Result<void> leave_branches(int index);
    Result<void> begin_loop(int index, Block& block);
    Result<void> end_loop(int index, Block& block);
    Result<void> leave_loop(int index, Block& block);
    Result<void> call(const OWord& word, Block& block);
    Result<void> return_from_sub(const OWord& word, Block& block);
    Result<std::optional<double>> read_condition(Block& block, Keyword keyword, bool required);
    std::unexpected<Error> refuse_unclosed(int index) const;
    std::unexpected<Error> refuse(int line, int column, std::string cause, std::string remedy) const;
    void forget_loops(std::size_t first) { repeats_.resize(first); }

    std::string_view bytes_;
    const GcodeOptions& options_;
    Lexer& lexer_;
    Parameters& parameters_;
    std::optional<Labels> labels_;  // of the whole text, made at the first use
    std::vector<Call> calls_;
    std::vector<Repeat> repeats_;
    RunLimit limit_;
};

}  // namespace tribo::readers::gcode
