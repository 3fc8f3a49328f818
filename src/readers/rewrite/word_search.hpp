// SPDX-License-Identifier: MIT
// Finds a word with a number in a line of a program, for those that write another number there.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "readers/rewrite/feed_words.hpp"

namespace tribo::readers {

// Where the number of a word stands in its line.
struct NumberWord {
    std::size_t at = 0, end = 0;
    double value = 0;
    bool computed = false;  // no number
};

// A number with a point or a decimal comma that begins there.
std::optional<NumberWord> number_at(std::string_view line, std::size_t at);

// Of a word that means the same in all languages.
struct WordName {
    char letter;                 // upper case
    std::string_view statement;  // of APT
};

// The first word of a block with this letter that is no part of a comment, a text, a name or an expression.
std::optional<NumberWord> word_in_block(std::string_view line, FeedLanguage language, char letter);
// The number of a statement of APT: FEDRAT/200,MMPM or FEDRAT/MMPM,200.
std::optional<NumberWord> word_in_statement(std::string_view line, std::string_view name);

inline std::optional<NumberWord> word_in_line(std::string_view line, FeedLanguage language, WordName name) {
    return language == FeedLanguage::apt ? word_in_statement(line, name.statement)
                                         : word_in_block(line, language, name.letter);
}

}  // namespace tribo::readers
