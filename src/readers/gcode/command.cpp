// SPDX-License-Identifier: MIT
#include "readers/gcode/command.hpp"

#include <cmath>
#include <string>

namespace tribo::readers::gcode {
namespace {

constexpr double kLargestCode = 9999;

// Returns the code in tenths; none for a number that cannot be a code.
std::optional<int> tenths_of(double value) {
    if (value < 0 || value > kLargestCode) return std::nullopt;
    const double tenths = std::floor(10 * value + 0.5);
    if (std::abs(10 * value - tenths) > 1e-6) return std::nullopt;
    return static_cast<int>(tenths);
}

std::unexpected<Error> refuse(int line, const Word& word, std::string cause, std::string remedy) {
    return fail_at({}, line, word.column, std::move(cause), std::move(remedy));
}

std::unexpected<Error> refuse_code(int line, const Word& word, std::optional<int> tenths, Unread unread) {
    std::string text = tenths ? code_text(word.letter, *tenths) : std::string(1, word.letter) + " code";
    if (unread.what.empty()) {
        text += " is not known";
    } else {
        text += " (" + std::string(unread.what) + ") is not read yet";
    }
    return refuse(line, word, std::move(text), std::string(unread.remedy));
}

std::unexpected<Error> refuse_pair(int line, const Word& word, int earlier, int later) {
    return refuse(line, word,
                  code_text(word.letter, later) + " contradicts " + code_text(word.letter, earlier) +
                      " in the same block",
                  "keep one of the two");
}

}  // namespace

std::string code_text(char letter, int tenths) {
    std::string text = letter + std::to_string(tenths / 10);
    if (tenths % 10 != 0) text += "." + std::to_string(tenths % 10);
    return text;
}

Result<void> Command::add_g(const Word& word) {
    const auto tenths = tenths_of(word.value);
    const auto group = tenths ? group_of_g(*tenths) : std::nullopt;
    if (!group) return refuse_code(line_, word, tenths, unread_g(tenths.value_or(-1)));
    auto& place = g_[static_cast<std::size_t>(*group)];
    if (place && place->tenths != *tenths) return refuse_pair(line_, word, place->tenths, *tenths);
    place = Code{*tenths, word.column};
    return {};
}

Result<void> Command::add_m(const Word& word) {
    const auto tenths = tenths_of(word.value);
    const auto group = tenths ? group_of_m(*tenths) : std::nullopt;
    if (!group) return refuse_code(line_, word, tenths, unread_m(tenths.value_or(-1)));
    auto& place = m_[static_cast<std::size_t>(*group)];
    // Mist and flood coolant may be on together.
    if (place && place->tenths != *tenths && *group != MGroup::coolant) {
        return refuse_pair(line_, word, place->tenths, *tenths);
    }
    place = Code{*tenths, word.column};
    return {};
}

Result<Command> Command::of(const Block& block) {
    Command command;
    command.line_ = block.line;
    command.block_ = &block;
    for (const Word& word : block.words) {
        Result<void> added;
        if (word.letter == 'G') {
            added = command.add_g(word);
        } else if (word.letter == 'M') {
            added = command.add_m(word);
        } else if (const Word*& place = command.words_[index(word.letter)]; place == nullptr) {
            place = &word;
        } else {
            added = refuse(block.line, word, std::string(1, word.letter) + " stands twice in the block",
                           "delete one of the two or start a new line between them");
        }
        if (!added) return std::unexpected(added.error());
    }
    return command;
}

bool Command::has_any(std::string_view letters) const {
    for (const char letter : letters) {
        if (has(letter)) return true;
    }
    return false;
}

const Word* Command::use(char letter) {
    used_ |= std::uint32_t{1} << index(letter);
    return words_[index(letter)];
}

const Word* Command::first_unused() const {
    for (const Word& word : block_->words) {
        if (word.letter == 'G' || word.letter == 'M') continue;
        if ((used_ >> index(word.letter) & 1) == 0) return &word;
    }
    return nullptr;
}

}  // namespace tribo::readers::gcode
