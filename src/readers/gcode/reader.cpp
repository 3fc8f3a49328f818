// SPDX-License-Identifier: MIT
#include "readers/gcode/reader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/limits.hpp"
#include "readers/control/dialect.hpp"
#include "readers/gcode/calls.hpp"
#include "readers/gcode/command.hpp"
#include "readers/gcode/denford.hpp"
#include "readers/gcode/flow.hpp"
#include "readers/gcode/frames/polar_words.hpp"
#include "readers/gcode/modes.hpp"
#include "readers/gcode/motion/compensation.hpp"
#include "readers/gcode/motion/corners.hpp"
#include "readers/gcode/motion/general_pocket.hpp"
#include "readers/gcode/motion/motion.hpp"
#include "readers/gcode/motion/offsets.hpp"
#include "readers/gcode/motion/rotary.hpp"
#include "readers/gcode/motion/splines.hpp"
#include "readers/gcode/passing.hpp"
#include "readers/gcode/state.hpp"
#include "readers/gcode/text/fanuc_variables.hpp"
#include "readers/gcode/text/lexer.hpp"
#include "readers/gcode/text/parameters.hpp"
#include "readers/gcode/text/tool_vectors.hpp"
#include "readers/gcode/text/unit_of_texts.hpp"

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
        output_.text = bytes;
        state_.unit_is_of_texts = options.dialect == GcodeDialect::fanuc && is_in_inches_by_texts(bytes);
        state_.unit_mm = mm_per(state_.unit_is_of_texts ? LengthUnit::inch : options.default_unit);
        state_.retract_to_r = options.dialect == GcodeDialect::linuxcnc;
        const ToolVectors vectors = tool_vectors_of(bytes);
        if (vectors == ToolVectors::none) return;
        state_.rotary.vectors = state_.rotary.by_length_code = true;
        state_.rotary.tip_control = output_.machine.has_value();
        state_.rotary.vectors_to_tip = vectors == ToolVectors::to_tip;
        output_.warn(0,
                     state_.rotary.vectors_to_tip
                         ? "I, J and K beside G0 and G1 have the length 1, and K is never above 0: they are "
                           "taken as the tool's axis, from the shank to the tip"
                         : "I, J and K beside G0 and G1 have the length 1: they are taken as the tool's "
                           "axis, from the tip to the shank, as with G43.5");
    }

    Result<motion::Program> read() {
        if (const auto line = line_of_isg_kernel(output_.text)) {
            return output_.refuse(
                *line, 1,
                "this is a program for the ISG kernel (Beckhoff TwinCAT CNC and others), whose "
                "words are not read",
                "post-process it for another control");
        }
        Block block;
        bool more = true;
        while (more) {
            auto goes_on = run_next(block);
            if (goes_on) {
                more = *goes_on;
            } else if (!goes_on_after(goes_on.error())) {
                return std::unexpected(std::move(goes_on.error()));
            }
        }
        auto program = finish(block.line);
        if (!program) goes_on_after(program.error());
        if (const Error* first = first_refusal(output_.options.refusals)) return std::unexpected(*first);
        return program;
    }

  private:
    // Returns false at the end of the program.
    Result<bool> run_next(Block& block) {
        if (auto done = flow_.leave_lines(); !done) return std::unexpected(done.error());
        if (auto done = mill_pocket_of(state_, flow_, output_); !done) return std::unexpected(done.error());
        state_.line = lexer_.place().number() + 1;
        const auto found = lexer_.next(block);
        if (!found) return std::unexpected(found.error());
        if (!*found) {
            is_over_ = true;
            if (auto done = flow_.end_text(block.line); !done) return std::unexpected(done.error());
            return false;
        }
        return run(block);
    }

    // Keeps a refusal where the caller wants them all. The reading goes on without the block; where the tool
    // is, nobody knows then.
    bool goes_on_after(const Error& error) {
        if (!keep_refusal(output_.options.refusals, error) || is_over_) return false;
        state_.known = {Known::lost, Known::lost, Known::lost};
        state_.lost_line = error.line;
        state_.compensation = {};
        state_.left_at_mm.reset();
        state_.nurbs = {};
        state_.corner.reset();
        state_.pocket.reset();
        state_.rotary.arrive();
        return true;
    }

    // Returns false at the end of the program.
    Result<bool> run(Block& block) {
        if (auto counted = flow_.count_step(block.line); !counted) {
            is_over_ = true;
            return std::unexpected(counted.error());
        }
        const bool changes_tool = std::ranges::any_of(
            block.words, [](const Word& word) { return word.letter == 'M' && word.value == 6; });
        const auto called = std::ranges::find(block.words, 'T', &Word::letter);
        const bool only_calls =
            !changes_tool && called != block.words.end() && kLimits.tool_number.range.contains(called->value);
        for (const std::string_view comment : block.comments) {
            output_.notes.read(comment, block.line, changes_tool,
                               only_calls ? std::optional(static_cast<int>(called->value)) : std::nullopt);
        }
        note_writing(block, output_);
        if (block.deletable && output_.options.skip_deletable_blocks) {
            if (output_.first(Note::deletable_blocks)) {
                output_.warn(block.line,
                             "blocks that start with '/' are skipped, as with block delete switched on");
            }
            return true;
        }
        if (block.setting.starts_with('[')) {
            if (auto done = take_denford_line(block, state_, output_); !done)
                return std::unexpected(done.error());
            return true;
        }
        if (!block.setting.empty()) {
            pass_setting(block, state_, output_);
            return true;
        }
        if (block.kind == BlockKind::percent) {
            output_.notes.read(block.label, block.line);
            return begins_or_goes_on(block);
        }
        if (block.kind == BlockKind::o_word) return run_o_word(block);
        for (const Assignment& assignment : block.assignments) {
            if (auto done = assign(assignment, block.line); !done) return std::unexpected(done.error());
        }
        if (block.kind == BlockKind::macro) {
            has_words_ = true;
            if (auto done = flow_.run_macro(block); !done) return std::unexpected(done.error());
            return true;
        }
        if (ends_with_alarm(block)) return false;
        if (auto done = place_polar_words(block, state_, output_); !done)
            return std::unexpected(done.error());
        if (block.words.empty()) return true;
        has_words_ = true;
        if (const Word* call = macro_call_in(block)) {
            const auto macro = read_macro_call(block, *call, output_);
            if (!macro) return std::unexpected(macro.error());
            if (call->value == 66) {  // runs after each move, from the next block on
                modal_macro_ = *macro;
                modal_depth_ = flow_.depth();
                return true;
            }
            if (auto done = call_macro(*macro, block.line, state_, flow_, output_); !done) {
                return std::unexpected(done.error());
            }
            return true;
        }

        if (pass_drawing_data(block, state_, output_)) return true;
        auto command = Command::of(block, parameters_.is_fanuc());
        if (!command) {
            command.error().file = output_.options.source_name;
            return std::unexpected(std::move(command.error()));
        }
        if (const auto first = command->overruled();
            first && output_.first(Note::overruled_code, first->tenths)) {
            output_.warn(block.line, code_text('G', first->tenths) + " and " +
                                         code_text('G', command->overruling().tenths) +
                                         " stand in one block: the last one holds, as on Fanuc controls");
        }
        return execute(*command);
    }

    // '%' begins and ends a program; with text behind it inside, it is a remark of the one who wrote it.
    bool begins_or_goes_on(const Block& block) {
        if (!has_words_) return !std::exchange(has_percent_, true);
        const bool is_remark = !block.label.empty() && block.label[0] != '(' && block.label[0] != ';';
        if (is_remark) {
            output_.warn(block.line,
                         "a line with '%' and text is taken as a remark, what follows as the same set-up: " +
                             std::string(block.label.substr(0, 60)));
        }
        return is_remark;
    }

    Result<void> assign(const Assignment& assignment, int line) {
        has_words_ = true;
        const ParameterName& to = assignment.to;
        auto done = to.name.empty() ? parameters_.set(to.number, assignment.value)
                                    : parameters_.set(to.name, assignment.value);
        if (done) return done;
        return output_.refuse(line, assignment.column, std::move(done.error().cause),
                              std::move(done.error().remedy));
    }

    // #3000 stops a Fanuc control with an alarm, #3006 with a message until somebody goes on.
    bool ends_with_alarm(const Block& block) {
        if (!parameters_.is_fanuc()) return false;
        for (const Assignment& assignment : block.assignments) {
            const int number = assignment.to.number;
            if (number != kAlarm && number != kStopWithMessage) continue;
            const std::string_view text = block.comments.empty() ? "" : block.comments.front();
            output_.warn(block.line, (number == kAlarm ? "the control stops here with an alarm: "
                                                       : "the control stops here with a message: ") +
                                         std::string(text));
            if (number == kAlarm) return true;
        }
        return false;
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
        if (has_words_) return true;
        const auto main = flow_.go_to_main(block.line);
        if (!main) return std::unexpected(main.error());
        if (*main) {
            output_.warn(block.line, "this program ends with M99, as subprograms do: O" + (*main)->label +
                                         " on line " + std::to_string((*main)->line) +
                                         " is read as the main program");
        }
        return true;
    }

    // The block goes somewhere: what calls the macro of G66.
    static bool moves(const Block& block) {
        return std::ranges::any_of(block.words,
                                   [](const Word& word) { return word.letter >= 'U' && word.letter <= 'Z'; });
    }

    // Nothing but moves, feeds and modes of numbers may stand between a corner and the move behind it.
    Result<void> check_corner(const Command& command) const {
        constexpr GGroup groups[] = {GGroup::non_modal,   GGroup::plane,    GGroup::cutter_side,
                                     GGroup::work_offset, GGroup::polar,    GGroup::scaling,
                                     GGroup::mirror,      GGroup::rotation, GGroup::tool_to_plane,
                                     GGroup::cylinder,    GGroup::probing};
        const bool ends =
            command.m(MGroup::tool) || command.m(MGroup::stop) ||
            std::ranges::any_of(groups, [&](GGroup group) { return command.g(group).has_value(); });
        return ends ? check_no_corner_waits(state_, output_, command.line()) : Result<void>{};
    }

    Result<bool> execute(Command& command) {
        if (state_.enters_data) {
            state_.enters_data = !command.has_g(GGroup::idle, 110);
            return true;
        }
        if (auto done = check_corner(command); !done) return std::unexpected(done.error());
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
        if (command.g(GGroup::pocket)) {
            if (auto done = begin_pocket(command, state_, flow_, output_); !done)
                return std::unexpected(done.error());
        } else if (!*consumed) {
            if (auto done = apply_motion(command, state_, output_); !done) {
                return std::unexpected(done.error());
            }
        }
        state_.rotary.arrive();
        const bool calls = command.m(MGroup::subprogram).has_value();
        if (calls) {
            command.use('P');
            command.use('L');
            if (command.m(MGroup::subprogram)->tenths == 970 || parameters_.is_fanuc()) command.use('Q');
            if (parameters_.is_fanuc()) command.use('H');
        }
        pass_unknown_codes(command, output_);
        if (auto done = pass_unused_words(command, state_, output_); !done)
            return std::unexpected(done.error());
        if (command.has_g(GGroup::idle, 670)) modal_macro_.reset();
        if (modal_macro_ && flow_.depth() == modal_depth_ && moves(command.block())) {
            if (auto done = call_macro(*modal_macro_, command.line(), state_, flow_, output_); !done) {
                return std::unexpected(done.error());
            }
        }
        if (calls) return call_or_return(command, state_, flow_, output_);
        const auto stop = command.m(MGroup::stop);
        return !(stop && (stop->tenths == 20 || stop->tenths == 300));
    }

    bool goes_on_behind_end() const {
        return lexer_.place().rest().find_first_not_of("% \t\v\f\r\n") != std::string_view::npos;
    }

    Result<motion::Program> finish(int last_line) {
        motion::Program& program = output_.program;
        if (state_.nurbs.runs && !state_.nurbs.has_knots) {
            return output_.refuse(state_.nurbs.line, state_.nurbs.column,
                                  "the B-spline that begins here is never ended",
                                  "write G5.3 after its last point");
        }
        if (auto done = finish_nurbs(state_, output_); !done) return std::unexpected(done.error());
        if (auto done = check_no_corner_waits(state_, output_, last_line); !done)
            return std::unexpected(done.error());
        if (state_.pocket) {
            return output_.refuse(state_.pocket->line, state_.pocket->column,
                                  "G150 has a contour that M99 does not end", "write M99 behind it");
        }
        if (auto done = end_compensation(state_, output_); !done) return std::unexpected(done.error());
        if (!has_words_) {
            if (has_percent_ && goes_on_behind_end()) {
                return output_.refuse(last_line, 1, "the program ends with this '%', before any G-code",
                                      "delete the line");
            }
            return output_.refuse(0, 0, "no G-code in this file", "check that it is the right one");
        }
        // Behind the end stand the programs that were called.
        if (!flow_.has_called() && goes_on_behind_end()) {
            output_.warn(last_line, "what follows the end of the program is not read");
        }
        if (output_.machine) {
            for (Warning& found : output_.machine->findings(program.source)) {
                program.warnings.push_back(std::move(found));
            }
        }
        output_.finish();
        declare_billet(state_, output_);
        note_lathe(state_, output_);
        note_least_increments(state_, output_);
        if (output_.moves == 0) output_.warn(0, "the program moves no tool");
        if (output_.moves > 0 && !output_.feeds && state_.feed)
            output_.warn(0, "all moves are rapids (G0), though F states a feed: a G1 may be missing");
        program.tools = output_.notes.tools(state_.unit_mm, program.source, program.warnings);
        return std::move(program);
    }

    Output output_;
    State state_;
    Parameters parameters_;
    Lexer lexer_;
    Flow flow_;
    std::optional<MacroCall> modal_macro_;  // of G66
    std::size_t modal_depth_ = 0;           // of calls at its G66
    bool has_percent_ = false, has_number_ = false, has_words_ = false;
    bool is_over_ = false;  // its loops do not end
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
