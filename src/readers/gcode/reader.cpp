// SPDX-License-Identifier: MIT
#include "readers/gcode/reader.hpp"

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "readers/gcode/command.hpp"
#include "readers/gcode/flow.hpp"
#include "readers/gcode/modes.hpp"
#include "readers/gcode/motion/compensation.hpp"
#include "readers/gcode/motion/motion.hpp"
#include "readers/gcode/motion/offsets.hpp"
#include "readers/gcode/motion/rotary.hpp"
#include "readers/gcode/motion/splines.hpp"
#include "readers/gcode/state.hpp"
#include "readers/gcode/text/lexer.hpp"
#include "readers/gcode/text/parameters.hpp"
#include "readers/gcode/text/tool_comment.hpp"

namespace tribo::readers {
namespace gcode {
namespace {

class ProgramReader {
  public:
    ProgramReader(std::string_view bytes, const GcodeOptions& options, MoveSink* sink)
        : output_(options, sink),
          parameters_(state_, output_),
          lexer_(bytes, options.source_name, options.skip_deletable_blocks, parameters_),
          flow_(bytes, options, lexer_, parameters_, output_.moves) {
        state_.unit_mm = mm_per(options.default_unit);
        state_.retract_to_r = options.dialect == GcodeDialect::linuxcnc;
    }

    Result<motion::Program> read() {
        Block block;
        bool more = true;
        while (more) {
            state_.line = lexer_.place().number() + 1;
            const auto found = lexer_.next(block);
            if (!found) return std::unexpected(found.error());
            if (!*found) {
                if (auto done = flow_.end_text(block.line); !done) return std::unexpected(done.error());
                break;
            }
            const auto goes_on = run(block);
            if (!goes_on) return std::unexpected(goes_on.error());
            more = *goes_on;
        }
        return finish(block.line);
    }

  private:
    // Returns false at the end of the program.
    Result<bool> run(Block& block) {
        if (auto counted = flow_.count_step(block.line); !counted) return std::unexpected(counted.error());
        for (const std::string_view comment : block.comments) read_comment(comment, block.line);
        if (block.deletable && output_.options.skip_deletable_blocks) {
            if (output_.first(Note::deletable_blocks)) {
                output_.warn(block.line,
                             "blocks that start with '/' are skipped, as with block delete switched on");
            }
            return true;
        }
        if (block.kind == BlockKind::percent) return !has_words_ && !std::exchange(has_percent_, true);
        if (block.kind == BlockKind::o_word) return run_o_word(block);
        for (const Assignment& assignment : block.assignments) {
            if (auto done = assign(assignment, block.line); !done) return std::unexpected(done.error());
        }
        if (block.words.empty()) return true;
        has_words_ = true;

        auto command = Command::of(block);
        if (!command) {
            command.error().file = output_.options.source_name;
            return std::unexpected(std::move(command.error()));
        }
        return execute(*command);
    }

    void read_comment(std::string_view comment, int line) {
        const auto tool = tool_in_comment(comment);
        if (!tool) return;
        if (!tool_lines_.insert(line).second) return;  // a loop may read the line again
        declared_.push_back({tool->number, tool->diameter, tool->corner, line});
        output_.declare_tool({tool->number, tool->diameter * state_.unit_mm});
    }

    Result<void> assign(const Assignment& assignment, int line) {
        has_words_ = true;
        const ParameterName& to = assignment.to;
        auto done = to.number != 0 ? parameters_.set(to.number, assignment.value)
                                   : parameters_.set(to.name, assignment.value);
        if (done) return done;
        return output_.refuse(line, assignment.column, std::move(done.error().cause),
                              std::move(done.error().remedy));
    }

    Result<bool> run_o_word(Block& block) {
        const auto is_number = flow_.run(block);
        if (!is_number) return std::unexpected(is_number.error());
        if (*is_number) return start_program(block);
        has_words_ = true;
        return true;
    }

    Result<bool> start_program(const Block& block) {
        if (std::exchange(has_number_, true)) {
            return output_.refuse(block.line, block.column, "a second program starts here",
                                  "give each program its own file");
        }
        return true;
    }

    Result<bool> execute(Command& command) {
        if (auto done = close_nurbs_before(command, state_, output_); !done) {
            return std::unexpected(done.error());
        }
        if (auto done = check_compensation(command, state_, output_); !done) {
            return std::unexpected(done.error());
        }
        if (auto done = apply_modes(command, state_, output_); !done) return std::unexpected(done.error());
        if (auto done = read_rotary_words(command, state_, output_); !done) {
            return std::unexpected(done.error());
        }
        const auto consumed = apply_non_modal(command, state_, output_);
        if (!consumed) return std::unexpected(consumed.error());
        if (!*consumed) {
            if (auto done = apply_motion(command, state_, output_); !done) {
                return std::unexpected(done.error());
            }
        }
        state_.rotary.arrive();
        const bool calls = command.m(MGroup::subprogram).has_value();
        if (calls) {
            command.use('P');
            command.use('L');
        }
        if (const Word* word = command.first_unused()) return refuse_unused(command, *word);
        if (calls) return call_or_return(command);
        const auto stop = command.m(MGroup::stop);
        return !(stop && (stop->tenths == 20 || stop->tenths == 300));
    }

    // M98 P L and M99
    Result<bool> call_or_return(Command& command) {
        const Code code = *command.m(MGroup::subprogram);
        const Word* number = command.use('P');
        const Word* times = command.use('L');
        const int line = command.line();
        if (code.tenths == 990) {
            if (number != nullptr) {
                return output_.refuse(line, number->column, "M99 P (return to another line) is not read",
                                      "let the control or the CAM system write the jump out");
            }
            const auto returned = flow_.return_from_program(line, code.column);
            if (returned && !*returned) {
                output_.warn(line, "M99 in the main program would run it again: it ends here");
            }
            return returned;
        }
        if (number == nullptr || !is_whole(*number, 1)) {
            return output_.refuse(line, number == nullptr ? code.column : number->column,
                                  "M98 needs the number of a program as P", "write M98 P1000 for O1000");
        }
        if (times != nullptr && !is_whole(*times, 0)) {
            return output_.refuse(line, times->column, "L of M98 is no number of times",
                                  "write a whole number");
        }
        if (times != nullptr && times->value == 0) return true;
        const auto count = times == nullptr ? 1L : static_cast<long>(times->value);
        if (auto done = flow_.call_program(*number, count, line); !done) return std::unexpected(done.error());
        return true;
    }

    static bool is_whole(const Word& word, double least) {
        constexpr double most = 999'999'999;
        return word.value >= least && word.value <= most && word.value == std::floor(word.value);
    }

    std::unexpected<Error> refuse_unused(const Command& command, const Word& word) const {
        const std::string letter(1, word.letter);
        switch (word.letter) {
            case 'U':
            case 'V':
            case 'W':
                return output_.refuse(command.line(), word.column, "axes U, V and W are not read yet",
                                      "let the CAM system write the path with X, Y and Z");
            case 'I':
            case 'J':
            case 'K':
            case 'R':
                return output_.refuse(command.line(), word.column, letter + " without an arc to use it",
                                      "write G2 or G3 before it, or delete the word");
            default:
                return output_.refuse(command.line(), word.column, letter + " without a code that uses it",
                                      "delete the word, or add the code that it belongs to");
        }
    }

    Result<motion::Program> finish(int last_line) {
        motion::Program& program = output_.program;
        if (state_.nurbs.runs && !state_.nurbs.has_knots) {
            return output_.refuse(state_.nurbs.line, state_.nurbs.column,
                                  "the B-spline that begins here is never ended",
                                  "write G5.3 after its last point");
        }
        if (auto done = finish_nurbs(state_, output_); !done) return std::unexpected(done.error());
        if (auto done = end_compensation(state_, output_); !done) return std::unexpected(done.error());
        if (!has_words_) {
            return output_.refuse(0, 0, "no G-code in this file", "check that it is the right one");
        }
        const std::string_view rest = lexer_.place().rest();
        if (rest.find_first_not_of("% \t\v\f\r\n") != std::string_view::npos) {
            output_.warn(last_line, "what follows the end of the program is not read");
        }
        if (output_.machine) {
            for (Warning& found : output_.machine->findings(program.source)) {
                program.warnings.push_back(std::move(found));
            }
        }
        if (output_.moves == 0) output_.warn(0, "the program moves no tool");
        for (motion::DeclaredTool& tool : declared_) {
            tool.diameter_mm *= state_.unit_mm;
            tool.corner_mm *= state_.unit_mm;
        }
        program.tools = std::move(declared_);
        return std::move(program);
    }

    Output output_;
    State state_;
    Parameters parameters_;
    Lexer lexer_;
    Flow flow_;
    std::vector<motion::DeclaredTool> declared_;  // in units of the program until the end
    std::set<int> tool_lines_;
    bool has_percent_ = false, has_number_ = false, has_words_ = false;
};

}  // namespace
}  // namespace gcode

Result<motion::Program> read_gcode(std::string_view bytes, const GcodeOptions& options) {
    return gcode::ProgramReader(bytes, options, nullptr).read();
}

Result<motion::Program> read_gcode(std::string_view bytes, const GcodeOptions& options, MoveSink& sink) {
    return gcode::ProgramReader(bytes, options, &sink).read();
}

}  // namespace tribo::readers
