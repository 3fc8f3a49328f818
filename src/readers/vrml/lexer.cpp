// SPDX-License-Identifier: MIT
#include "readers/vrml/lexer.hpp"

#include <charconv>

#include "readers/text/model_text.hpp"

namespace tribo::readers {
namespace {

bool is_separator(char c) {
    return static_cast<unsigned char>(c) <= ' ' || c == ',';
}
bool ends_word(char c) {
    return is_separator(c) || c == '{' || c == '}' || c == '[' || c == ']' || c == '"' || c == '#';
}

// Returns the number if the whole word is one. Integers may be hexadecimal with 0x or 0X.
std::optional<double> number_of(std::string_view word) {
    const char first = word.front();
    if ((first < '0' || first > '9') && first != '+' && first != '-' && first != '.') return std::nullopt;
    std::string_view digits = word;
    const bool negative = digits.starts_with('-');
    if (negative || digits.starts_with('+')) digits.remove_prefix(1);
    if (!digits.starts_with("0x") && !digits.starts_with("0X")) return parse_number(word);
    digits.remove_prefix(2);
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
    return negative ? -static_cast<double>(value) : static_cast<double>(value);
}

}  // namespace

void VrmlLexer::advance_line(char c) {
    const bool second_of_pair = c == '\n' && at_ > 0 && text_[at_ - 1] == '\r';
    if (c == '\r' || (c == '\n' && !second_of_pair)) ++line_;
    if (c == '\r' || c == '\n') line_start_ = at_ + 1;
}

void VrmlLexer::skip_blanks_and_comments() {
    for (; at_ < text_.size(); ++at_) {
        if (text_[at_] == '#') {
            while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
            if (at_ == text_.size()) return;
        }
        if (!is_separator(text_[at_])) return;
        advance_line(text_[at_]);
    }
}

VrmlToken VrmlLexer::string_token(VrmlToken token) {
    const std::size_t start = ++at_;
    for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
        advance_line(text_[at_]);
        if (text_[at_] == '\\' && at_ + 1 < text_.size()) advance_line(text_[++at_]);
    }
    token.text = text_.substr(start, at_ - start);
    token.kind = at_ >= text_.size()             ? VrmlTokenKind::unterminated
                 : token.text.size() > kMaxToken ? VrmlTokenKind::too_long
                                                 : VrmlTokenKind::string;
    if (at_ < text_.size()) ++at_;
    return token;
}

VrmlToken VrmlLexer::next() {
    skip_blanks_and_comments();
    VrmlToken token;
    token.line = line_;
    token.column = static_cast<int>(at_ - line_start_) + 1;
    token.offset = static_cast<std::uint32_t>(at_);
    if (at_ == text_.size()) return token;
    token.text = text_.substr(at_, 1);
    switch (text_[at_]) {
        case '{':
            token.kind = VrmlTokenKind::open_brace;
            break;
        case '}':
            token.kind = VrmlTokenKind::close_brace;
            break;
        case '[':
            token.kind = VrmlTokenKind::open_bracket;
            break;
        case ']':
            token.kind = VrmlTokenKind::close_bracket;
            break;
        case '"':
            return string_token(token);
        default:
            break;
    }
    if (token.kind != VrmlTokenKind::end) {
        ++at_;
        return token;
    }
    const std::size_t start = at_;
    while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
    token.text = text_.substr(start, at_ - start);
    token.kind = VrmlTokenKind::word;
    if (token.text.size() > kMaxToken) {
        token.kind = VrmlTokenKind::too_long;
    } else if (const auto number = number_of(token.text)) {
        token.kind = VrmlTokenKind::number;
        token.number = *number;
    }
    return token;
}

void VrmlLexer::rewind(const VrmlToken& token) {
    at_ = token.offset;
    line_ = token.line;
    line_start_ = at_ + 1 - static_cast<std::size_t>(token.column);
}

}  // namespace tribo::readers
