// SPDX-License-Identifier: MIT
#include "formats/gcode_reader.hpp"

#include <utility>
#include <vector>

#include "formats/gcode_command.hpp"
#include "formats/gcode_lexer.hpp"
#include "formats/gcode_modes.hpp"
#include "formats/gcode_motion.hpp"
#include "formats/gcode_offsets.hpp"
#include "formats/gcode_state.hpp"
#include "formats/gcode_tool_comment.hpp"

namespace tribo::formats {
namespace gcode {
namespace {

class Reader {
  public:
    Reader(std::string_view bytes, const GcodeOptions& options)
        : lexer_(bytes, options.source_name, options.skip_deletable_blocks), output_(options) {
        state_.unit_mm = mm_per(options.default_unit);
    }

    Result<motion::Program> read() {
        Block block;
        bool more = true;
        while (more) {
            const auto found = lexer_.next(block);
            if (!found) return std::unexpected(found.error());
            if (!*found) break;
            const auto goes_on = run(block);
            if (!goes_on) return std::unexpected(goes_on.error());
            more = *goes_on;
        }
        return finish(block.line);
    }

  private:
    // False where the program ends.
    Result<bool> run(const Block& block) {
        for (const std::string_view comment : block.comments) {
            if (const auto tool = tool_in_comment(comment)) {
                declared_.push_back({tool->number, tool->diameter, tool->corner, block.line});
            }
        }
        if (block.deletable && output_.options.skip_deletable_blocks) {
            if (output_.first(Note::deletable_blocks)) {
                output_.warn(block.line,
                             "blocks that start with '/' are skipped, as with block delete switched on");
            }
            return true;
        }
        if (block.kind == BlockKind::percent) return !has_words_ && !std::exchange(has_percent_, true);
        if (block.kind == BlockKind::program_number) return start_program(block);
        if (block.words.empty()) return true;
        has_words_ = true;

        auto command = Command::of(block);
        if (!command) {
            command.error().file = output_.options.source_name;
            return std::unexpected(std::move(command.error()));
        }
        return execute(*command);
    }

    Result<bool> start_program(const Block& block) {
        if (std::exchange(has_number_, true)) {
            return output_.refuse(block.line, block.column, "a second program starts here",
                                  "give each program its own file");
        }
        return true;
    }

    Result<bool> execute(Command& command) {
        note_rotary_words(command);
        if (auto done = apply_modes(command, state_, output_); !done) return std::unexpected(done.error());
        const auto consumed = apply_non_modal(command, state_, output_);
        if (!consumed) return std::unexpected(consumed.error());
        if (!*consumed) {
            if (auto done = apply_motion(command, state_, output_); !done) {
                return std::unexpected(done.error());
            }
        }
        if (const Word* word = command.first_unused()) return refuse_unused(command, *word);
        const auto stop = command.m(MGroup::stop);
        return !(stop && (stop->tenths == 20 || stop->tenths == 300));
    }

    void note_rotary_words(Command& command) {
        if (!command.has_any("ABC")) return;
        for (const char letter : {'A', 'B', 'C'}) command.use(letter);
        motion::Program& program = output_.program;
        if (!program.has_rotary_words) program.first_rotary_line = command.line();
        program.has_rotary_words = true;
        if (output_.first(Note::rotary_words)) {
            output_.warn(command.line(),
                         "rotary words (A B C) mean nothing without a machine: their motion is left out");
        }
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
        if (!has_words_) {
            return output_.refuse(0, 0, "no G-code in this file", "check that it is the right one");
        }
        const std::string_view rest = lexer_.rest();
        if (rest.find_first_not_of("% \t\v\f\r\n") != std::string_view::npos) {
            output_.warn(last_line, "what follows the end of the program is not read");
        }
        if (program.moves.empty()) output_.warn(0, "the program moves no tool");
        for (motion::DeclaredTool& tool : declared_) {
            tool.diameter_mm *= state_.unit_mm;
            tool.corner_mm *= state_.unit_mm;
        }
        program.tools = std::move(declared_);
        return std::move(program);
    }

    Lexer lexer_;
    Output output_;
    State state_;
    std::vector<motion::DeclaredTool> declared_;  // in units of the program until the end
    bool has_percent_ = false, has_number_ = false, has_words_ = false;
};

}  // namespace
}  // namespace gcode

Result<motion::Program> read_gcode(std::string_view bytes, const GcodeOptions& options) {
    return gcode::Reader(bytes, options).read();
}

}  // namespace tribo::formats
