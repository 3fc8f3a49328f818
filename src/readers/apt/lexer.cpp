// SPDX-License-Identifier: MIT
#include "readers/apt/lexer.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace tribo::readers::apt {
namespace {

constexpr std::array<std::string_view, 7> kTextWords{"PARTNO", "PPRINT", "REMARK", "INSERT",
                                                     "TPRINT", "TITLES", "LETTER"};

// Returns the text word at the start of the line. No blank is needed between the word and its text.
std::string_view text_word(std::string_view line) {
    for (const std::string_view word : kTextWords) {
        if (matches(line.substr(0, word.size()), word)) return line.substr(0, word.size());
    }
    return {};
}

}  // namespace

bool matches(std::string_view text, std::string_view word) {
    return std::ranges::equal(text, word, {}, to_upper, to_upper);
}

Lexer::Lexer(std::string_view bytes, std::string source_name)
    : lines_(bytes), source_name_(std::move(source_name)) {}

std::unexpected<Error> Lexer::refuse(std::size_t at, std::string cause, std::string remedy) const {
    return fail_at(source_name_, lines_.number(), static_cast<int>(at) + 1, std::move(cause),
                   std::move(remedy));
}

// Fetches a line and removes the comment ('$$') and the continuation ('$'). Returns false at the end of the
// text.
bool Lexer::begin_line() {
    const auto line = lines_.next();
    at_ = 0;
    continues_ = false;
    line_ = line.value_or(std::string_view{});
    if (!line) return false;
    if (!text_word(trimmed(line_)).empty()) return true;
    const std::size_t mark = line_.find('$');
    if (mark != std::string_view::npos) {
        continues_ = mark + 1 >= line_.size() || line_[mark + 1] != '$';
        line_ = line_.substr(0, mark);
    }
    return true;
}

Result<bool> Lexer::next(Statement& statement) {
    statement.items.clear();
    statement.is_text = false;
    do {
        if (!begin_line()) return false;
    } while (trimmed(line_).empty());

    const std::size_t indent = line_.find_first_not_of(" \t\v\f");
    if (const std::string_view word = text_word(line_.substr(indent)); !word.empty()) {
        statement.word = {word, lines_.number(), static_cast<int>(indent) + 1};
        statement.is_text = true;
        return true;
    }
    const std::size_t slash = line_.find('/');
    statement.word = {trimmed(line_.substr(0, slash)), lines_.number(), static_cast<int>(indent) + 1};
    if (statement.word.text.empty()) {
        return refuse(indent, "no word before the slash", "write the statement's word there");
    }
    if (slash == std::string_view::npos) {
        if (!continues_) return true;
        return refuse(line_.size(), "a statement goes on ($) before its slash", "put the slash on this line");
    }
    at_ = slash + 1;
    if (auto read = read_items(statement); !read) return std::unexpected(read.error());
    return true;
}

Result<void> Lexer::read_items(Statement& statement) {
    bool item_due = true;
    for (;;) {
        while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
        if (at_ >= line_.size()) {
            if (!continues_) break;
            if (!begin_line()) {
                return refuse(0, "the statement goes on ($) where the file ends",
                              "delete the '$' or add the missing lines");
            }
        } else if (line_[at_] == ',') {
            if (item_due) statement.items.push_back({{}, lines_.number(), static_cast<int>(at_) + 1});
            item_due = true;
            ++at_;
        } else if (item_due) {
            const std::size_t comma = std::min(line_.find(',', at_), line_.size());
            statement.items.push_back(
                {trimmed(line_.substr(at_, comma - at_)), lines_.number(), static_cast<int>(at_) + 1});
            item_due = false;
            at_ = comma;
        } else {
            return refuse(at_, "a comma is missing between this line and the one before", "add it");
        }
    }
    if (item_due && !statement.items.empty()) {
        statement.items.push_back({{}, lines_.number(), static_cast<int>(line_.size())});
    }
    return {};
}

}  // namespace tribo::readers::apt
