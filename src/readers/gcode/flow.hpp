// SPDX-License-Identifier: MIT
// The flow of control: O-word subroutines, branches and loops of LinuxCNC, M98 and M99 of Fanuc's kind. It
// decides which line the lexer reads next.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/gcode/text/labels.hpp"
#include "readers/gcode/text/lexer.hpp"
#include "readers/gcode/text/parameters.hpp"

namespace tribo::readers::gcode {

class Flow {
  public:
    // All arguments must outlive it.
    Flow(std::string_view bytes, const GcodeOptions& options, Lexer& lexer, Parameters& parameters);

    // Runs an o_word block that the lexer has just given. True where it is a program number in the way of
    // the program that runs, at the outermost level.
    Result<bool> run(Block& block);

    // M98: runs the program of that number, `times` times.
    Result<void> call_program(const Word& number, long times, int line);
    // M99; false where no program has called this one.
    Result<bool> return_from_program(int line, int column);
    // The text has ended: refused within a subroutine or loop.
    Result<void> end_text(int line) const;
    bool is_outermost() const { return calls_.empty(); }

    // Counts a block. Refused where the program seems to run for ever.
    Result<void> count_step(int line);

  private:
    // A call that has not returned.
    struct Call {
        TextLines back;           // the line after the call
        int callee = -1;          // its landmark
        long times_left = 0;      // after this one
        std::size_t loops = 0;    // that were running when it was called
        bool is_program = false;  // M98
    };
    // A repeat loop that runs.
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
    std::optional<Labels> labels_;  // of the whole text, once something asks for them
    std::vector<Call> calls_;
    std::vector<Repeat> repeats_;
    std::size_t steps_ = 0;
};

}  // namespace tribo::readers::gcode
