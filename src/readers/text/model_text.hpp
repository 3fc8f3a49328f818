// SPDX-License-Identifier: MIT
// Words and lines of text model files, with their place.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::readers {

// Longest word in a model file, bytes. A file with a longer word is not a model.
inline constexpr std::size_t kMaxToken = 64 * 1024;

// Reads a text word by word. Blanks are space, tab, vertical tab and form feed; a line ends at LF, CR or
// both.
class TextCursor {
  public:
    explicit TextCursor(std::string_view text) : text_(text) {}

    // Returns the next word of this line; empty at its end.
    std::string_view word_on_line();
    // Returns the next word on any line; empty at the end of the text.
    std::string_view word();
    // Moves to the start of the next line.
    void next_line();
    // Returns the rest of this line, without its line end.
    std::string_view rest_of_line();
    bool at_end() const { return at_ >= text_.size(); }
    std::size_t offset() const { return at_; }
    std::string_view rest() const { return text_.substr(at_); }

    // Place of the last word, from 1.
    int line() const { return word_line_; }
    int column() const { return word_column_; }

  private:
    void skip_blanks();
    bool skip_line_end();

    std::string_view text_;
    std::size_t at_ = 0, line_start_ = 0;
    int line_ = 1, word_line_ = 1, word_column_ = 1;
};

// Returns the number if the whole word is one, else none. Unlike number_of(), a number that is too large
// gives infinity, so that a vertex too far away is distinguished from a word that is not a number.
std::optional<double> parse_number(std::string_view word);
// Returns the integer if the whole word is one, else none.
std::optional<long long> parse_integer(std::string_view word);
// For ASCII only, so that no locale matters.
bool equals_ignoring_case(std::string_view a, std::string_view b);
// Returns the word in quotes for messages: shortened, and without bytes that are not plain ASCII (they are
// replaced).
std::string quoted(std::string_view word);
// Returns the text after its byte order mark, if it has one.
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace tribo::readers
