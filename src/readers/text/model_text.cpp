// SPDX-License-Identifier: MIT
#include "readers/text/model_text.hpp"

#include <charconv>

#include "base/text/decimal.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

bool is_line_end(char c) {
    return c == '\n' || c == '\r';
}

}  // namespace

void TextCursor::skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

bool TextCursor::skip_line_end() {
    if (at_ >= text_.size() || !is_line_end(text_[at_])) return false;
    at_ += text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
    line_start_ = at_;
    ++line_;
    return true;
}

std::string_view TextCursor::word_on_line() {
    skip_blanks();
    const std::size_t start = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && !is_line_end(text_[at_])) ++at_;
    word_line_ = line_;
    word_column_ = static_cast<int>(start - line_start_) + 1;
    return text_.substr(start, at_ - start);
}

std::string_view TextCursor::word() {
    for (;;) {
        const std::string_view found = word_on_line();
        if (!found.empty() || !skip_line_end()) return found;
    }
}

std::string_view TextCursor::rest_of_line() {
    skip_blanks();
    const std::size_t start = at_;
    while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
}

void TextCursor::next_line() {
    rest_of_line();
    skip_line_end();
}

std::optional<double> parse_number(std::string_view word) {
    double value = 0;
    const std::size_t used = parse_decimal(word, value);
    if (used == 0 || used != word.size()) return std::nullopt;
    return value;
}

std::optional<long long> parse_integer(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    long long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

bool equals_ignoring_case(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (to_upper(a[i]) != to_upper(b[i])) return false;
    }
    return true;
}

std::string quoted(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string text = "'";
    for (const char c : word.substr(0, longest)) text += c >= 0x20 && c < 0x7f ? c : '?';
    return text + (word.size() > longest ? "...'" : "'");
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
    return text.starts_with(utf8_mark) ? text.substr(utf8_mark.size()) : text;
}

}  // namespace tribo::readers
