// SPDX-License-Identifier: MIT
#include "readers/apt/lexer.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace tribo::readers::apt {
namespace {

constexpr std::array<std::string_view, 7> kTextWords{"PARTNO", "PPRINT", "REMARK", "INSERT",
                                                     "TPRINT", "TITLES", "LETTER"};

constexpr std::string_view kCreoHeader = "$$->", kCatiaHeader = "$$*CATIA0";
constexpr std::string_view kBlanks = " \t\v\f";

bool is_comment(std::string_view line) {
    return trimmed(line).starts_with("$$");
}

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

// Fetches a line. Returns false at the end of the text.
bool Lexer::begin_line() {
    const auto line = lines_.next();
    at_ = 0;
    continues_ = false;
    line_ = line.value_or(std::string_view{});
    // Old systems end a file with this character.
    if (line_.ends_with('\x1a')) line_.remove_suffix(1);
    return line.has_value();
}

void Lexer::cut_comment(std::size_t from) {
    const std::size_t mark = line_.find('$', from);
    continues_ = false;
    if (mark == std::string_view::npos) return;
    continues_ = mark + 1 >= line_.size() || line_[mark + 1] != '$';
    line_ = line_.substr(0, mark);
}

Result<bool> Lexer::next(Statement& statement) {
    for (;;) {
        statement.items.clear();
        statement.is_text = statement.is_header = false;
        if (!begin_line()) return false;
        const std::size_t indent = std::min(line_.find_first_not_of(kBlanks), line_.size());
        const std::string_view text = line_.substr(indent);
        if (const std::string_view word = text_word(text); !word.empty()) {
            statement.word = {word, lines_.number(), static_cast<int>(indent) + 1};
            statement.is_text = true;
            return true;
        }
        if (text.starts_with(kCatiaHeader)) {
            read_catia_matrix(statement);
            return true;
        }
        statement.is_header = text.starts_with(kCreoHeader);
        const std::size_t start = statement.is_header ? indent + kCreoHeader.size() : indent;
        cut_comment(start);
        if (line_.find_first_not_of(kBlanks, start) == std::string_view::npos) continue;
        if (auto read = read_statement(statement, start); !read) return std::unexpected(read.error());
        return true;
    }
}

// Reads the statement that begins in this line, from `from` on.
Result<void> Lexer::read_statement(Statement& statement, std::size_t from) {
    const std::size_t indent = line_.find_first_not_of(kBlanks, from);
    const std::size_t slash = line_.find('/', indent);
    statement.word = {trimmed(line_.substr(indent, slash == std::string_view::npos ? slash : slash - indent)),
                      lines_.number(), static_cast<int>(indent) + 1};
    if (statement.word.text.empty()) {
        return refuse(indent, "no word before the slash", "write the statement's word there");
    }
    if (slash == std::string_view::npos) {
        if (!continues_) return {};
        return refuse(line_.size(), "a statement goes on ($) before its slash", "put the slash on this line");
    }
    at_ = slash + 1;
    return read_items(statement);
}

// Reads the name and the three rows of four numbers below the header. Without them the statement has no
// items.
void Lexer::read_catia_matrix(Statement& statement) {
    const std::size_t indent = line_.find(kCatiaHeader);
    statement.word = {line_.substr(indent + 3, kCatiaHeader.size() - 3), lines_.number(),
                      static_cast<int>(indent) + 4};
    statement.is_header = true;
    TextLines ahead = lines_;
    std::vector<Item> items;
    for (int row = -1; row < 3; ++row) {
        const auto line = ahead.next();
        if (!line || !is_comment(*line)) return;
        if (row < 0) continue;
        std::size_t at = line->find("$$") + 2;
        while ((at = line->find_first_not_of(kBlanks, at)) != std::string_view::npos) {
            const std::size_t end = std::min(line->find_first_of(kBlanks, at), line->size());
            items.push_back({line->substr(at, end - at), ahead.number(), static_cast<int>(at) + 1});
            at = end;
        }
        if (items.size() != 4 * (static_cast<std::size_t>(row) + 1)) return;
    }
    lines_ = ahead;
    statement.items = std::move(items);
}

Result<void> Lexer::read_items(Statement& statement) {
    bool item_due = true;
    for (;;) {
        while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
        if (at_ >= line_.size()) {
            if (!continues_) break;
            do {
                if (!begin_line()) {
                    return refuse(0, "the statement goes on ($) where the file ends",
                                  "delete the '$' or add the missing lines");
                }
            } while (is_comment(line_));
            cut_comment(0);
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
