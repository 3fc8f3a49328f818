// SPDX-License-Identifier: MIT
#include "readers/gcode/flow.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace tribo::readers::gcode {
namespace {

// The limit is 10 in LinuxCNC and 4 to 20 in other controls.
constexpr std::size_t kDeepestCall = 100;
constexpr double kMostRepeats = 1e9;
constexpr std::int64_t kFourDigits = 10'000;

std::string called_label(const std::string& label) {
    return "o" + label;
}

}  // namespace

Flow::Flow(std::string_view bytes, const GcodeOptions& options, Lexer& lexer, Parameters& parameters,
           const std::size_t& moves)
    : bytes_(bytes),
      options_(options),
      lexer_(lexer),
      parameters_(parameters),
      limit_(options, bytes.size(), moves) {}

std::unexpected<Error> Flow::refuse(int line, int column, std::string cause, std::string remedy) const {
    return fail_at(options_.source_name, line, column, std::move(cause), std::move(remedy));
}

Result<void> Flow::require_labels() {
    if (labels_) return {};
    auto labels = Labels::of(bytes_, options_.source_name, options_.skip_deletable_blocks);
    if (!labels) return std::unexpected(labels.error());
    labels_ = std::move(*labels);
    return {};
}

std::unexpected<Error> Flow::refuse_unclosed(int index) const {
    const Landmark& mark = (*labels_)[index];
    const std::string_view keyword = spelling(mark.keyword);
    const std::string closer = mark.keyword == Keyword::do_ ? "while" : "end" + std::string(keyword);
    return refuse(mark.line, 1, called_label(mark.label) + " " + std::string(keyword) + " is never closed",
                  "add " + called_label(mark.label) + " " + closer + " after it");
}

Result<void> Flow::count_step(int line) {
    auto cause = limit_.count(lexer_.cursor().line.size());
    if (!cause) return {};
    return refuse(line, 1, *std::move(cause), RunLimit::kRemedy);
}

Result<std::optional<double>> Flow::read_condition(Block& block, Keyword keyword, bool required) {
    Cursor& cursor = lexer_.cursor();
    std::optional<double> value;
    if (cursor.peek_after_blanks() == '[') {
        const auto read = read_value(cursor, parameters_);
        if (!read) return std::unexpected(read.error());
        value = *read;
    } else if (required) {
        return cursor.refuse(cursor.at, std::string(spelling(keyword)) + " without its [expression]",
                             "write it in square brackets");
    }
    if (auto end = lexer_.read_end(block); !end) return std::unexpected(end.error());
    return value;
}

Result<bool> Flow::run(Block& block) {
    Cursor& cursor = lexer_.cursor();
    const std::size_t start = cursor.at;
    const auto word = read_o_word(cursor, &parameters_);
    if (!word) return std::unexpected(word.error());
    if (word->is_computed && word->keyword != Keyword::call) {
        return cursor.refuse(start, "only a call may compute its label", "write the number out");
    }
    if (word->keyword == Keyword::none) {
        if (auto end = lexer_.read_end(block); !end) return std::unexpected(end.error());
        if (calls_.empty()) return true;
        return cursor.refuse(start,
                             "another program starts here before M99 has ended the one that was called",
                             "end each subprogram with M99");
    }
    if (auto known = require_labels(); !known) return std::unexpected(known.error());
    const int index = labels_->on_line(block.line);
    if (index < 0 && word->keyword != Keyword::call) {
        return cursor.refuse(start, "an O-word does not stand at the start of its line",
                             "move what is before it to the line above");
    }
    const auto done = [&]() -> Result<void> {
        switch (word->keyword) {
            case Keyword::sub: {
                const Landmark& mark = (*labels_)[index];
                if (mark.closer < 0) return refuse_unclosed(index);
                lexer_.go_to((*labels_)[mark.closer].after);
                return {};
            }
            case Keyword::endsub:
            case Keyword::return_:
                return return_from_sub(*word, block);
            case Keyword::call:
                return call(*word, block);
            case Keyword::if_:
                return branch(index, block);
            case Keyword::elseif:
            case Keyword::else_:
            case Keyword::endif:
                return leave_branches(index);
            case Keyword::do_:
            case Keyword::repeat:
                return begin_loop(index, block);
            case Keyword::while_:
                return (*labels_)[index].opener < 0 ? begin_loop(index, block) : end_loop(index, block);
            case Keyword::endwhile:
            case Keyword::endrepeat:
                return end_loop(index, block);
            default:
                return leave_loop(index, block);
        }
    }();
    if (!done) return std::unexpected(done.error());
    return false;
}

// Runs if, and each elseif before the taken branch.
Result<void> Flow::branch(int index, Block& block) {
    if ((*labels_)[index].closer < 0) return refuse_unclosed(index);
    for (;;) {
        const Landmark& mark = (*labels_)[index];
        const auto is_true = read_condition(block, mark.keyword, true);
        if (!is_true) return std::unexpected(is_true.error());
        if (**is_true != 0) return {};
        index = mark.next_branch;
        const Landmark& next = (*labels_)[index];
        if (next.keyword != Keyword::elseif) {
            lexer_.go_to(next.after);
            return {};
        }
        lexer_.go_to(next.at);
        if (auto given = lexer_.next(block); !given) return std::unexpected(given.error());
        if (auto counted = count_step(block.line); !counted) return counted;
        if (auto word = read_o_word(lexer_.cursor(), nullptr); !word) return std::unexpected(word.error());
    }
}

// Skips the branches after a taken branch.
Result<void> Flow::leave_branches(int index) {
    const Landmark& mark = (*labels_)[index];
    if (mark.opener < 0) {
        return refuse(
            mark.line, 1,
            called_label(mark.label) + " " + std::string(spelling(mark.keyword)) + " without its if",
            "add " + called_label(mark.label) + " if before it, with the same label");
    }
    const int closer = (*labels_)[mark.opener].closer;
    if (closer < 0) return refuse_unclosed(mark.opener);
    lexer_.go_to((*labels_)[closer].after);
    return {};
}

Result<void> Flow::begin_loop(int index, Block& block) {
    const Landmark& mark = (*labels_)[index];
    if (mark.closer < 0) return refuse_unclosed(index);
    if (mark.keyword == Keyword::do_) return lexer_.read_end(block);
    const auto value = read_condition(block, mark.keyword, true);
    if (!value) return std::unexpected(value.error());
    if (mark.keyword == Keyword::while_) {
        if (**value == 0) lexer_.go_to((*labels_)[mark.closer].after);
        return {};
    }
    const double times = std::floor(**value + 0.5);
    if (times > kMostRepeats) {
        return refuse(block.line, 1, "a loop is to be repeated more than a thousand million times",
                      "correct the number");
    }
    if (times < 1) {
        lexer_.go_to((*labels_)[mark.closer].after);
    } else {
        repeats_.push_back({index, static_cast<long>(times)});
    }
    return {};
}

Result<void> Flow::end_loop(int index, Block& block) {
    const Landmark& mark = (*labels_)[index];
    if (mark.opener < 0) {
        return refuse(mark.line, 1,
                      called_label(mark.label) + " " + std::string(spelling(mark.keyword)) +
                          " without the start of its loop",
                      "add it before this line, with the same label");
    }
    const Landmark& opener = (*labels_)[mark.opener];
    if (mark.keyword == Keyword::endwhile) {
        lexer_.go_to(opener.at);
        return {};
    }
    if (mark.keyword == Keyword::while_) {
        const auto is_true = read_condition(block, mark.keyword, true);
        if (!is_true) return std::unexpected(is_true.error());
        if (**is_true != 0) lexer_.go_to(opener.after);
        return {};
    }
    if (repeats_.empty() || repeats_.back().opener != mark.opener) {
        return refuse(mark.line, 1, called_label(mark.label) + " endrepeat without the start of its loop",
                      "enter loops at their start only");
    }
    if (--repeats_.back().left > 0) {
        lexer_.go_to(opener.after);
    } else {
        repeats_.pop_back();
    }
    return {};
}

// break and continue
Result<void> Flow::leave_loop(int index, Block& block) {
    if (auto end = lexer_.read_end(block); !end) return end;
    const Landmark& mark = (*labels_)[index];
    const bool ends = mark.keyword == Keyword::break_;
    if (mark.opener < 0) {
        return refuse(mark.line, 1,
                      called_label(mark.label) + " " + std::string(spelling(mark.keyword)) +
                          " stands in no loop of that label",
                      "give it the label of the loop around it");
    }
    const Landmark& opener = (*labels_)[mark.opener];
    if (opener.closer < 0) return refuse_unclosed(mark.opener);
    const int innermost = ends ? mark.opener : mark.opener + 1;
    const std::size_t least = calls_.empty() ? 0 : calls_.back().repeats;
    while (repeats_.size() > least && repeats_.back().opener >= innermost) repeats_.pop_back();
    const Landmark& closer = (*labels_)[opener.closer];
    lexer_.go_to(ends ? closer.after : opener.keyword == Keyword::while_ ? opener.at : closer.at);
    return {};
}

Result<void> Flow::call(const OWord& word, Block& block) {
    std::array<double, kLocalParameters> arguments;
    std::size_t count = 0;
    Cursor& cursor = lexer_.cursor();
    for (;;) {
        // A comment may stand between the arguments.
        while (cursor.peek_after_blanks() == '(') {
            const std::size_t end = cursor.line.find(')', cursor.at);
            if (end == std::string_view::npos) break;
            cursor.at = end + 1;
        }
        if (cursor.peek() != '[') break;
        if (count == arguments.size()) {
            return cursor.refuse(cursor.at, "a call has more than 30 arguments",
                                 "pass the rest in named parameters");
        }
        const auto value = read_value(cursor, parameters_);
        if (!value) return std::unexpected(value.error());
        arguments[count++] = *value;
    }
    if (auto end = lexer_.read_end(block); !end) return end;
    const int sub = labels_->find_sub(word.label);
    if (sub < 0 && options_.missing_programs != nullptr) {
        const bool is_name = word.label.starts_with('<') && word.label.ends_with('>');
        options_.missing_programs->push_back(is_name ? word.label.substr(1, word.label.size() - 2)
                                                     : word.label);
        return {};
    }
    if (sub < 0) {
        return refuse(block.line, block.column,
                      called_label(word.label) + " is called, but this file has no " +
                          called_label(word.label) + " sub",
                      "lay its file beside this one, or copy the subroutine into this file");
    }
    if ((*labels_)[sub].closer < 0) return refuse_unclosed(sub);
    Call call;
    call.entry = (*labels_)[sub].after;
    call.name = word.label;
    call.has_variables = true;
    if (auto pushed = push(std::move(call), block.line, block.column); !pushed) return pushed;
    parameters_.enter({arguments.data(), count});
    return {};
}

// Begins a call: the callee runs next.
Result<void> Flow::push(Call call, int line, int column) {
    if (calls_.size() == kDeepestCall) {
        return refuse(line, column, "subroutines call each other more than 100 deep",
                      "end the recursion earlier");
    }
    call.back = lexer_.place();
    call.repeats = repeats_.size();
    call.macro_loops = macro_loops_.size();
    lexer_.go_to(call.entry);
    has_called_ = true;
    calls_.push_back(std::move(call));
    return {};
}

Result<void> Flow::return_from_sub(const OWord& word, Block& block) {
    const auto value = read_condition(block, word.keyword, false);
    if (!value) return std::unexpected(value.error());
    if (calls_.empty() || calls_.back().is_program || calls_.back().name != word.label) {
        return refuse(block.line, block.column,
                      called_label(word.label) + " " + std::string(spelling(word.keyword)) +
                          " stands outside of that subroutine",
                      "give it the label of the sub around it");
    }
    parameters_.leave();
    parameters_.set_returned(*value);
    lexer_.go_to(calls_.back().back);
    forget_loops(calls_.back());
    calls_.pop_back();
    return {};
}

Result<std::optional<Flow::MainProgram>> Flow::go_to_main(int line) {
    if (auto known = require_labels(); !known) return std::unexpected(known.error());
    const int index = labels_->main_program();
    if (index < 0 || (*labels_)[index].line <= line) return std::nullopt;
    const Landmark& main = (*labels_)[index];
    lexer_.go_to(main.after);
    return MainProgram{main.label, main.line};
}

Result<bool> Flow::has_program(const Word& number) {
    if (auto known = require_labels(); !known) return std::unexpected(known.error());
    return labels_->find_program(std::to_string(static_cast<std::int64_t>(number.value))) >= 0;
}

Result<void> Flow::call_program(const Word& number, std::int64_t times, int line, const Arguments* arguments,
                                const Word* from) {
    if (auto known = require_labels(); !known) return known;
    const auto value = static_cast<std::int64_t>(number.value);
    std::string label = std::to_string(value);
    int program = labels_->find_program(label);
    // Older controls write the number of times before the four digits of the program: P30100.
    if (program < 0 && value > kFourDigits && arguments == nullptr) {
        const std::string last = std::to_string(value % kFourDigits);
        if (const int found = labels_->find_program(last); found >= 0) {
            program = found;
            label = last;
            times *= value / kFourDigits;
        }
    }
    if (program < 0 && options_.missing_programs != nullptr) {
        options_.missing_programs->push_back(label);
        return {};
    }
    return run_program(program, "O" + label, times, line, number.column, arguments, from);
}

Result<void> Flow::call_named_program(const std::string& name, std::int64_t times, int line, int column,
                                      const Arguments* arguments, const Word* from) {
    if (auto known = require_labels(); !known) return known;
    const std::string label = "<" + name + ">";
    const int program = labels_->find_program(label);
    if (program < 0 && options_.missing_programs != nullptr) {
        options_.missing_programs->push_back(name);
        return {};
    }
    return run_program(program, label, times, line, column, arguments, from);
}

// `program`: its index; -1: none. `label`: as the program writes it.
Result<void> Flow::run_program(int program, const std::string& label, std::int64_t times, int line,
                               int column, const Arguments* arguments, const Word* from) {
    if (program < 0) {
        return refuse(line, column,
                      std::string(arguments == nullptr ? "M98" : "G65") + " calls " + label +
                          ", which this file does not have",
                      "lay its file beside this one, or copy the subprogram behind the main program, from " +
                          label + " to M99");
    }
    Call call;
    call.entry = (*labels_)[program].after;
    if (from != nullptr) {
        if (auto known = require_places(); !known) return known;
        const int first = static_cast<int>(from->value);
        const TextLines* place = places_->find_number(first, call.entry.number());
        if (place == nullptr) {
            return refuse(line, from->column,
                          "M98 begins at N" + std::to_string(first) + ", which " + label + " lacks",
                          "write the number of one of its lines");
        }
        call.entry = *place;
    }
    call.name = label;
    call.times_left = times - 1;
    call.is_program = true;
    call.has_variables = arguments != nullptr;
    if (auto pushed = push(std::move(call), line, column); !pushed) return pushed;
    if (arguments != nullptr) parameters_.enter_macro(*arguments);
    return {};
}

Result<bool> Flow::return_from_program(int line, int column, const Word* to) {
    if (calls_.empty()) return false;
    Call& call = calls_.back();
    if (!call.is_program) {
        return refuse(line, column, "M99 stands in a subroutine that an O-word has called",
                      "end it with endsub");
    }
    forget_loops(call);
    if (call.times_left > 0) {
        --call.times_left;
        lexer_.go_to(call.entry);
        return true;
    }
    const TextLines back = call.back;
    if (call.has_variables) parameters_.leave();
    calls_.pop_back();
    lexer_.go_to(back);
    if (to == nullptr) return true;
    if (auto jumped = jump(static_cast<int>(to->value), line, back); !jumped) {
        return std::unexpected(jumped.error());
    }
    return true;
}

Result<void> Flow::end_text(int line) const {
    if (calls_.empty()) return {};
    const Call& call = calls_.back();
    return refuse(line, 1,
                  call.is_program ? "the text ends before M99 has ended " + call.name
                                  : "the text ends before o" + call.name + " endsub",
                  "end each subprogram with M99 and each sub with endsub");
}

}  // namespace tribo::readers::gcode
