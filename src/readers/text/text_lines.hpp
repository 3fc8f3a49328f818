// SPDX-License-Identifier: MIT
// The lines of a text file with their numbers, and a character in a form for messages.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tribo::readers {

// Reads the lines of a text. A line ends at LF, CR or CR LF. A UTF-8 byte order mark at the start is skipped.
class TextLines {
  public:
    explicit TextLines(std::string_view text);

    // Returns the next line without its line end; none after the last one.
    std::optional<std::string_view> next();
    // Number of the last line of next(), from 1.
    int number() const { return number_; }
    // The text after the last line of next().
    std::string_view rest() const { return rest_; }

  private:
    std::string_view rest_;
    int number_ = 0;
};

// Longest block of a program, characters. Controls take 80 to 512; the work on a block may grow with the
// square of its length.
inline constexpr std::size_t kLongestBlock = 4096;

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
constexpr bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
// For ASCII only, so that no locale matters.
constexpr char to_upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

std::string_view trimmed(std::string_view text);

// Returns the number if the whole text is one, with an optional sign. Returns none for other text, and for a
// number too large for a double.
std::optional<double> number_of(std::string_view text);

// Returns the cause of the refusal of a longer block.
std::string too_long_block(std::size_t characters);

// Returns the character for messages: 'x', or byte 0xE9 if it is not plain ASCII.
std::string shown_character(char c);

}  // namespace tribo::readers
