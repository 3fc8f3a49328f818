// SPDX-License-Identifier: MIT
#include "readers/text/text_lines.hpp"

#include <cmath>

#include "base/text/decimal.hpp"

namespace tribo::readers {

TextLines::TextLines(std::string_view text) : rest_(text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
}

std::optional<std::string_view> TextLines::next() {
    if (rest_.empty()) return std::nullopt;
    ++number_;
    std::size_t end = 0;
    while (end < rest_.size() && rest_[end] != '\n' && rest_[end] != '\r') ++end;
    const std::string_view line = rest_.substr(0, end);
    if (end == rest_.size()) {
        rest_ = {};
    } else {
        const bool both = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
        rest_.remove_prefix(end + (both ? 2 : 1));
    }
    return line;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::optional<double> number_of(std::string_view text) {
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    if (text.empty() || !(is_digit(text.front()) || text.front() == '.')) return std::nullopt;
    double value = 0;
    if (parse_decimal(text, value) != text.size() || !std::isfinite(value)) return std::nullopt;
    return negative ? -value : value;
}

std::string too_long_block(std::size_t characters) {
    return "the block has " + std::to_string(characters) + " characters, more than " +
           std::to_string(kLongestBlock);
}

std::string shown_character(char c) {
    if (c > ' ' && c <= '~') return std::string("'") + c + "'";
    constexpr std::string_view hex = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    return std::string("byte 0x") + hex[byte >> 4] + hex[byte & 15];
}

}  // namespace tribo::readers
