// SPDX-License-Identifier: MIT
// Words and lines of text model files, with their place.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::readers {

// Longest word that a model file may hold, bytes; a longer one is not a model.
inline constexpr std::size_t kMaxToken = 64 * 1024;

// Walks text word by word. Blanks are space, tab, vertical tab and form feed; a line ends at LF, CR or both.
class TextCursor {
  public:
    explicit TextCursor(std::string_view text) : text_(text) {}

    // The next word of this line; empty at its end.
    std::string_view word_on_line();
    // The next word, on whatever line; empty at the end of the text.
    std::string_view word();
    // To the start of the next line.
    void next_line();
    // The rest of this line, without what ends it.
    std::string_view rest_of_line();
    bool at_end() const { return at_ >= text_.size(); }
    std::size_t offset() const { return at_; }
    std::string_view rest() const { return text_.substr(at_); }

    // Where the last word stands, from 1.
    int line() const { return word_line_; }
    int column() const { return word_column_; }

  private:
    void skip_blanks();
    bool skip_line_end();

    std::string_view text_;
    std::size_t at_ = 0, line_start_ = 0;
    int line_ = 1, word_line_ = 1, word_column_ = 1;
};

// The number that the whole word spells; none when it spells none. Unlike number_of, it is infinite where it
// is too large: a vertex too far away is told apart from one that is no number.
std::optional<double> parse_number(std::string_view word);
// The integer that the whole word spells.
std::optional<long long> parse_integer(std::string_view word);
// ASCII only, so that no locale matters.
bool equals_ignoring_case(std::string_view a, std::string_view b);
// The word between quotes as a message may show it: cut short, bytes that are not plain ASCII replaced.
std::string quoted(std::string_view word);
// The text after a byte order mark, if it starts with one.
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace tribo::readers
