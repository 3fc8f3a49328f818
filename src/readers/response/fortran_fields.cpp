// SPDX-License-Identifier: MIT
#include "readers/response/fortran_fields.hpp"

#include <cmath>
#include <string>

#include "base/text/decimal.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kLongestNumber = 60;

std::size_t digits_at(std::string_view text, std::size_t at) {
    std::size_t count = 0;
    while (at + count < text.size() && is_digit(text[at + count])) ++count;
    return count;
}

}  // namespace

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < line.size();) {
        if (is_blank(line[at])) {
            ++at;
            continue;
        }
        std::size_t end = at;
        while (end < line.size() && !is_blank(line[end])) ++end;
        words.push_back(line.substr(at, end - at));
        at = end;
    }
    return words;
}

std::string_view columns(std::string_view line, std::size_t from, std::size_t width) {
    return from < line.size() ? line.substr(from, width) : std::string_view();
}

std::size_t next_fortran_number(std::string_view text, double& value) {
    std::size_t end = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    const std::size_t before = digits_at(text, end);
    end += before;
    std::size_t after = 0;
    if (end < text.size() && text[end] == '.') {
        after = digits_at(text, end + 1);
        end += 1 + after;
    }
    if (before + after == 0 || end > kLongestNumber) return 0;
    std::string number(text.substr(0, end));
    if (end < text.size()) {
        const char mark = to_upper(text[end]);
        const bool has_letter = mark == 'E' || mark == 'D';
        std::size_t at = end + (has_letter ? 1 : 0);
        const bool has_sign = at < text.size() && (text[at] == '-' || text[at] == '+');
        const std::size_t digits = digits_at(text, at + (has_sign ? 1 : 0));
        const std::size_t over = at + (has_sign ? 1 : 0) + digits;
        // Without a letter only an exponent of three digits is one: else the next number begins.
        const bool is_bare =
            !has_letter && has_sign && digits == 3 && !(over < text.size() && text[over] == '.');
        if ((has_letter && digits > 0 && digits <= 4) || is_bare) {
            number += 'e';
            number += text.substr(at, over - at);
            end = over;
        }
    }
    return parse_decimal(number, value) == number.size() ? end : 0;
}

std::optional<double> fortran_number(std::string_view text) {
    text = trimmed(text);
    double value = 0;
    if (text.empty()) return value;
    if (next_fortran_number(text, value) != text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

}  // namespace tribo::readers
