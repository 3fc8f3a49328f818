// SPDX-License-Identifier: MIT
// The part of the control flow that goes to line numbers: Fanuc macro statements and M97.
#include <string>
#include <utility>

#include "readers/gcode/flow.hpp"

namespace tribo::readers::gcode {

Result<void> Flow::require_places() {
    if (places_) return {};
    auto places = MacroPlaces::of(bytes_, options_.source_name, options_.skip_deletable_blocks);
    if (!places) return std::unexpected(places.error());
    places_ = std::move(*places);
    return {};
}

// Goes to the line N of the number, in the program around `from`.
Result<void> Flow::jump(int number, int line, const TextLines& from) {
    if (auto known = require_places(); !known) return known;
    const TextLines* place = places_->find_number(number, from.number());
    if (place == nullptr) {
        return refuse(line, 1, "the program has no line N" + std::to_string(number) + " to go to",
                      "write it, or correct the jump");
    }
    lexer_.go_to(*place);
    return {};
}

Result<void> Flow::run_macro(const Block& block) {
    switch (block.macro.kind) {
        case MacroKind::jump:
            return block.macro.holds ? jump(block.macro.number, block.line, lexer_.place()) : Result<void>{};
        case MacroKind::loop:
            return begin_macro_loop(block);
        default:
            return end_macro_loop(block);
    }
}

// WHILE [] DO
Result<void> Flow::begin_macro_loop(const Block& block) {
    const int number = block.macro.number;
    // A loop of the same number is this one again, or one that a jump has left.
    for (std::size_t i = first_macro_loop(); i < macro_loops_.size(); ++i) {
        if (macro_loops_[i].number == number) macro_loops_.resize(i);
    }
    if (block.macro.holds) {
        macro_loops_.push_back({number, lexer_.block_place()});
        return {};
    }
    if (auto known = require_places(); !known) return known;
    const TextLines* end = places_->find_end(number, block.line);
    if (end == nullptr) {
        return refuse(block.line, 1, "DO" + std::to_string(number) + " has no END" + std::to_string(number),
                      "add it after the loop");
    }
    lexer_.go_to(*end);
    return {};
}

Result<void> Flow::end_macro_loop(const Block& block) {
    const int number = block.macro.number;
    for (std::size_t i = macro_loops_.size(); i > first_macro_loop(); --i) {
        if (macro_loops_[i - 1].number != number) continue;
        lexer_.go_to(macro_loops_[i - 1].at);
        macro_loops_.resize(i);
        return {};
    }
    return refuse(block.line, 1, "END" + std::to_string(number) + " without its DO",
                  "write WHILE [...] DO" + std::to_string(number) + " before the loop");
}

Result<bool> Flow::has_lines(const Word& number, int line) {
    if (auto known = require_places(); !known) return std::unexpected(known.error());
    return places_->find_number(static_cast<int>(number.value), line) != nullptr;
}

Result<void> Flow::call_lines(const Word& number, const Word* last, std::int64_t times, int line,
                              const std::string& code) {
    if (auto known = require_places(); !known) return known;
    const int wanted = static_cast<int>(number.value);
    const TextLines* entry = places_->find_number(wanted, line);
    if (entry == nullptr) {
        return refuse(line, number.column,
                      code + " calls N" + std::to_string(wanted) + ", which this program lacks",
                      "write N" + std::to_string(wanted) + " before the first line of the subprogram");
    }
    Call call;
    call.entry = *entry;
    call.name = "N" + std::to_string(wanted);
    call.times_left = times - 1;
    call.is_program = true;
    if (last != nullptr) {
        const int number_of_last = static_cast<int>(last->value);
        const TextLines* end = places_->find_number(number_of_last, entry->number() + 1);
        if (end == nullptr || end->number() < entry->number()) {
            return refuse(line, last->column,
                          "the lines from N" + std::to_string(wanted) + " have no N" +
                              std::to_string(number_of_last) + " behind them",
                          "write it before the last line to run");
        }
        call.last_line = end->number() + 1;
        if (line > entry->number() && line <= call.last_line)
            return refuse(line, number.column, "lines that are to run again hold their own call",
                          "write the call behind them");
    }
    return push(std::move(call), line, number.column);
}

Result<void> Flow::leave_lines() {
    while (!calls_.empty() && calls_.back().last_line > 0 &&
           calls_.back().last_line == lexer_.place().number()) {
        const int line = calls_.back().last_line;
        const std::size_t depth = calls_.size();
        if (auto returned = return_from_program(line, 1, nullptr); !returned)
            return std::unexpected(returned.error());
        if (calls_.size() == depth) break;  // once more
    }
    return {};
}

}  // namespace tribo::readers::gcode
