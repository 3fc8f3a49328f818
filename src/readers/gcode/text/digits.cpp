// SPDX-License-Identifier: MIT
#include "readers/gcode/text/digits.hpp"

#include <algorithm>
#include <array>

namespace tribo::readers::gcode {
namespace {

// Longest number, characters without sign and blanks. No control writes half as many.
constexpr std::size_t kLongestNumber = 64;

bool is_number_character(char c) {
    return is_digit(c) || c == '.';
}

}  // namespace

Result<std::optional<double>> read_digits(Cursor& cursor, std::size_t start) {
    const std::string_view line = cursor.line;
    const std::size_t first = cursor.at;
    std::size_t end = first;
    while (end < line.size() && is_number_character(line[end])) ++end;
    if (end == first) return std::nullopt;
    std::string_view text = line.substr(first, end - first);
    cursor.at = end;
    // Blanks among the digits do not count: RS274/NGC 3.3.2.
    std::array<char, kLongestNumber> joined;
    if (is_number_character(cursor.peek_after_blanks())) {
        std::size_t length = 0;
        cursor.at = first;
        while (is_number_character(cursor.peek_after_blanks())) {
            if (length < joined.size()) joined[length] = cursor.peek();
            ++length;
            ++cursor.at;
        }
        text = {joined.data(), std::min(length, joined.size())};
        if (length > joined.size()) end = first + length;  // too long: refused below
    }
    if (end - first > kLongestNumber) {
        return cursor.refuse(start, "a number has more than 64 digits", "round it");
    }
    const auto value = number_of(text);
    if (!value) {
        return cursor.refuse(start, "the number " + std::string(text) + " is malformed",
                             "write it with digits and at most one decimal point");
    }
    return value;
}

Result<void> read_angled_name(Cursor& cursor, std::string& name) {
    const std::size_t open = cursor.at++;
    name.clear();
    while (cursor.at < cursor.line.size() && cursor.line[cursor.at] != '>') {
        const char c = cursor.line[cursor.at++];
        if (is_blank(c)) continue;
        name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    if (cursor.at >= cursor.line.size()) {
        return cursor.refuse(open, "a name is opened with '<' and not closed on this line",
                             "add the missing '>'");
    }
    if (name.empty()) return cursor.refuse(open, "a name without letters", "write letters between < and >");
    ++cursor.at;
    return {};
}

}  // namespace tribo::readers::gcode
