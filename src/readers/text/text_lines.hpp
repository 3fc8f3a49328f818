// SPDX-License-Identifier: MIT
// The lines of a text file, with their numbers, and how a piece of one is shown in a message.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tribo::readers {

// Walks the lines of a text. A line ends at LF, CR or CR LF; a UTF-8 byte order mark at the start is left
// out.
class TextLines {
  public:
    explicit TextLines(std::string_view text);

    // The next line without what ends it; none after the last one.
    std::optional<std::string_view> next();
    // Number of the line that next() gave last, from 1.
    int number() const { return number_; }
    // What next() has not given yet.
    std::string_view rest() const { return rest_; }

  private:
    std::string_view rest_;
    int number_ = 0;
};

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
constexpr bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
// ASCII only, so that no locale matters.
constexpr char to_upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

std::string_view trimmed(std::string_view text);

// The number that the whole text spells, with a sign before it if need be; none when it spells none, or one
// too large for a double.
std::optional<double> number_of(std::string_view text);

// The character as a message may show it: 'x', or byte 0xE9 where it is not plain ASCII.
std::string shown_character(char c);

}  // namespace tribo::readers
