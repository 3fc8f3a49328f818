// SPDX-License-Identifier: MIT
// Control flow: O-word subroutines, branches and loops of LinuxCNC, M97 to M99, G65 and macro statements of
// the Fanuc family. It decides which line the lexer reads next.
#pragma once

#include <array>
#include <cstdint>
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

    // Runs a macro block that the lexer has just read.
    Result<void> run_macro(const Block& block);

    // M98: runs the program of that number, `times` times, each time from its line N of `from` on if that is
    // given. G65: with variables of its own.
    using Arguments = std::array<double, kMacroParameters>;
    Result<void> call_program(const Word& number, std::int64_t times, int line,
                              const Arguments* arguments = nullptr, const Word* from = nullptr);
    // M98<NAME>, G65<NAME>: the same for the program of that name, in lower case.
    Result<void> call_named_program(const std::string& name, std::int64_t times, int line, int column,
                                    const Arguments* arguments = nullptr, const Word* from = nullptr);
    // At the first program number: goes on in the main program of the text (Labels::main_program). Returns
    // its label and line where it is another one.
    struct MainProgram {
        std::string label;
        int line = 0;
    };
    Result<std::optional<MainProgram>> go_to_main(int line);
    // True if the text has the program of that number.
    Result<bool> has_program(const Word& number);
    // True if the program has a line of that number.
    Result<bool> has_lines(const Word& number, int line);
    // M97, M98 Q: the same for lines of this program, from N to M99, or to the line N of `last`. `code` is
    // the text of the calling code.
    Result<void> call_lines(const Word& number, const Word* last, std::int64_t times, int line,
                            const std::string& code);
    // Returns from the calls whose last line has just run.
    Result<void> leave_lines();
    // M99. Returns false if no program has called this one. `to`: the line N that it returns to, or null.
    Result<bool> return_from_program(int line, int column, const Word* to);
    // At the end of the text. Refuses an open subroutine or loop.
    Result<void> end_text(int line) const;
    // Calls without their return so far.
    bool has_called() const { return has_called_; }
    std::size_t depth() const { return calls_.size(); }

    // Counts the block that the lexer has just read. Refuses a program that seems to run forever.
    Result<void> count_step(int line);

  private:
    // A call without its return so far.
    struct Call {
        TextLines back = TextLines({});   // the line after the call
        TextLines entry = TextLines({});  // first line of the callee
        std::string name;                 // of the callee, for messages and o-words
        std::int64_t times_left = 0;      // after this run
        std::size_t repeats = 0;          // number of running repeat loops at the call
        std::size_t macro_loops = 0;      // the same of DO
        int last_line = 0;                // of M97 P Q; 0: it ends with M99
        bool is_program = false;          // M97, M98, G65
        bool has_variables = false;       // a level of its own
    };
    // A running repeat loop.
    struct Repeat {
        int opener = -1;
        long left = 0;
    };

    // A running DO.
    struct MacroLoop {
        int number = 0;
        TextLines at = TextLines({});  // its WHILE
    };

    Result<void> run_program(int program, const std::string& label, std::int64_t times, int line, int column,
                             const Arguments* arguments, const Word* from);
    Result<void> require_labels();
    Result<void> require_places();
    Result<void> jump(int number, int line, const TextLines& from);
    Result<void> begin_macro_loop(const Block& block);
    Result<void> end_macro_loop(const Block& block);
    Result<void> push(Call call, int line, int column);
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
    void forget_loops(const Call& call) {
        repeats_.resize(call.repeats);
        macro_loops_.resize(call.macro_loops);
    }
    std::size_t first_macro_loop() const { return calls_.empty() ? 0 : calls_.back().macro_loops; }

    std::string_view bytes_;
    const GcodeOptions& options_;
    Lexer& lexer_;
    Parameters& parameters_;
    std::optional<Labels> labels_;       // of the whole text, made at the first use
    std::optional<MacroPlaces> places_;  // the same
    std::vector<Call> calls_;
    bool has_called_ = false;
    std::vector<Repeat> repeats_;
    std::vector<MacroLoop> macro_loops_;
    RunLimit limit_;
};

}  // namespace tribo::readers::gcode
