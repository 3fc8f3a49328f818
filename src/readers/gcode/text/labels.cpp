// SPDX-License-Identifier: MIT
#include "readers/gcode/text/labels.hpp"

#include <algorithm>
#include <cmath>

#include "readers/gcode/text/expression.hpp"
#include "readers/gcode/text/lexer.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr std::size_t kMostLandmarks = 1'000'000;  // about 150 MB
constexpr std::size_t kDeepestLoops = 1000;

struct Spelled {
    std::string_view text;
    Keyword keyword;
};
constexpr Spelled kKeywords[] = {
    {"sub", Keyword::sub},
    {"endsub", Keyword::endsub},
    {"return", Keyword::return_},
    {"call", Keyword::call},
    {"do", Keyword::do_},
    {"while", Keyword::while_},
    {"endwhile", Keyword::endwhile},
    {"if", Keyword::if_},
    {"elseif", Keyword::elseif},
    {"else", Keyword::else_},
    {"endif", Keyword::endif},
    {"repeat", Keyword::repeat},
    {"endrepeat", Keyword::endrepeat},
    {"break", Keyword::break_},
    {"continue", Keyword::continue_},
};

Result<std::string> read_label(Cursor& cursor, const Parameters* parameters, bool& is_computed) {
    const std::size_t start = cursor.at;
    if (cursor.peek_after_blanks() != '<') ++cursor.at;  // behind O, or ':'
    std::string label;
    const char c = cursor.peek_after_blanks();
    if (c == '<') {
        if (auto read = read_angled_name(cursor, label); !read) return std::unexpected(read.error());
        return "<" + label + ">";
    }
    if (c == '#' || c == '[') {
        is_computed = true;
        if (parameters == nullptr) return cursor.refuse(start, "a computed label", "write a number");
        const auto value = read_value(cursor, *parameters);
        if (!value) return std::unexpected(value.error());
        const double whole = std::floor(*value + 0.5);
        if (!(whole >= 0) || whole > kLargestLabel) {
            return cursor.refuse(start, "the number after O is negative or too large", "correct it");
        }
        return std::to_string(static_cast<long>(whole));
    }
    while (is_digit(cursor.peek_after_blanks())) {
        if (label == "0") label.clear();
        label += cursor.peek();
        ++cursor.at;
        if (label.size() > 9) return cursor.refuse(start, "the number after O is too large", "shorten it");
    }
    if (label.empty()) {
        return cursor.refuse(start, "O without a number or <name>",
                             "write O100 or o<name> and what it does: sub, call, if, while, ...");
    }
    return label;
}

// The last M2, M30 or M99 of a program; 0: none.
int last_end(std::string_view program) {
    TextLines lines(program);
    int last = 0;
    while (const auto line = lines.next()) {
        int depth = 0;
        for (std::size_t at = 0; at < line->size() && (*line)[at] != ';'; ++at) {
            const char c = (*line)[at];
            if (c == '(' || c == ')') depth = std::max(depth + (c == '(' ? 1 : -1), 0);
            if (depth > 0 || to_upper(c) != 'M') continue;
            int code = 0;
            std::size_t end = at + 1;
            while (end < line->size() && is_digit((*line)[end]) && code < 1000)
                code = 10 * code + ((*line)[end++] - '0');
            if (end > at + 1 && (code == 2 || code == 30 || code == 99)) last = code;
        }
    }
    return last;
}

}  // namespace

std::string_view spelling(Keyword keyword) {
    for (const Spelled& spelled : kKeywords) {
        if (spelled.keyword == keyword) return spelled.text;
    }
    return "program";
}

Result<OWord> read_o_word(Cursor& cursor, const Parameters* parameters) {
    OWord read;
    auto label = read_label(cursor, parameters, read.is_computed);
    if (!label) return std::unexpected(label.error());
    read.label = std::move(*label);
    cursor.skip_blanks();
    const std::size_t start = cursor.at;
    std::string text;
    while (is_letter(cursor.peek()) && text.size() < 20) {
        text += static_cast<char>(to_upper(cursor.peek()) - 'A' + 'a');
        ++cursor.at;
        cursor.skip_blanks();
    }
    if (text.empty()) return read;
    for (const Spelled& spelled : kKeywords) {
        if (spelled.text == text) read.keyword = spelled.keyword;
    }
    if (read.keyword == Keyword::none) {
        return cursor.refuse(start, "'" + text + "' is nothing that an O-word does",
                             "write sub, endsub, return, call, do, while, endwhile, if, elseif, else, endif, "
                             "repeat, endrepeat, break or continue; a program number stands alone");
    }
    return read;
}

Result<Labels> Labels::of(std::string_view bytes, const std::string& source_name, bool skip_deletable) {
    Labels labels;
    TextLines lines(bytes);
    Cursor cursor;
    cursor.source_name = &source_name;
    for (;;) {
        const TextLines at = lines;
        const auto line = lines.next();
        if (!line) break;
        cursor.line = *line;
        cursor.at = 0;
        cursor.number = lines.number();
        if (skip_block_head(cursor) && skip_deletable) continue;
        if (!starts_o_word(cursor)) continue;
        cursor.skip_blanks();
        const std::size_t start = cursor.at;
        auto word = read_o_word(cursor, nullptr);
        if (!word) continue;  // the error is reported when the line is run
        if (labels.marks_.size() == kMostLandmarks) {
            return cursor.refuse(start, "the program has more than a million O-words", "split it");
        }
        Landmark mark{std::move(word->label), word->keyword, lines.number(), at, lines};
        labels.add(std::move(mark));
        if (labels.open_.size() > kDeepestLoops) {
            return cursor.refuse(start, "more than 1000 O-words are opened within each other",
                                 "close subroutines, branches and loops with endsub, endif, endwhile, ...");
        }
    }
    return labels;
}

int Labels::innermost(std::string_view label, std::initializer_list<Keyword> keywords) const {
    for (auto open = open_.rbegin(); open != open_.rend(); ++open) {
        const Landmark& mark = (*this)[*open];
        if (mark.label != label) continue;
        if (std::find(keywords.begin(), keywords.end(), mark.keyword) != keywords.end()) return *open;
    }
    return -1;
}

// Openers inside `opener` that are still open keep no closer.
void Labels::close(int index, int opener) {
    marks_[static_cast<std::size_t>(opener)].closer = index;
    while (!open_.empty() && open_.back() >= opener) open_.pop_back();
}

void Labels::add(Landmark mark) {
    const int index = static_cast<int>(marks_.size());
    const std::string& label = mark.label;
    int opener = -1;
    bool closes = false;
    switch (mark.keyword) {
        case Keyword::none:
            programs_.emplace(label, index);
            break;
        case Keyword::sub:
            subs_.emplace(label, index);
            open_.push_back(index);
            break;
        case Keyword::do_:
        case Keyword::if_:
        case Keyword::repeat:
            open_.push_back(index);
            break;
        case Keyword::while_:
            opener = innermost(label, {Keyword::do_});
            closes = opener >= 0;
            if (!closes) open_.push_back(index);
            break;
        case Keyword::endsub:
            opener = innermost(label, {Keyword::sub});
            closes = true;
            break;
        case Keyword::endwhile:
            opener = innermost(label, {Keyword::while_});
            closes = true;
            break;
        case Keyword::endrepeat:
            opener = innermost(label, {Keyword::repeat});
            closes = true;
            break;
        case Keyword::elseif:
        case Keyword::else_:
        case Keyword::endif: {
            opener = innermost(label, {Keyword::if_});
            closes = mark.keyword == Keyword::endif;
            if (opener >= 0) {
                Landmark& first = marks_[static_cast<std::size_t>(opener)];
                const int last = first.last_branch < 0 ? opener : first.last_branch;
                marks_[static_cast<std::size_t>(last)].next_branch = index;
                first.last_branch = index;
            }
            break;
        }
        case Keyword::break_:
        case Keyword::continue_:
            opener = innermost(label, {Keyword::while_, Keyword::do_, Keyword::repeat});
            break;
        default:
            break;
    }
    mark.opener = opener;
    marks_.push_back(std::move(mark));
    if (closes && opener >= 0) close(index, opener);
}

int Labels::on_line(int line) const {
    const auto found = std::lower_bound(marks_.begin(), marks_.end(), line,
                                        [](const Landmark& mark, int wanted) { return mark.line < wanted; });
    if (found == marks_.end() || found->line != line) return -1;
    return static_cast<int>(found - marks_.begin());
}

int Labels::find_sub(std::string_view label) const {
    const auto found = subs_.find(label);
    return found == subs_.end() ? -1 : found->second;
}

int Labels::find_program(std::string_view label) const {
    const auto found = programs_.find(label);
    return found == programs_.end() ? -1 : found->second;
}

int Labels::main_program() const {
    std::vector<int> programs;
    for (int index = 0; index < static_cast<int>(marks_.size()); ++index)
        if ((*this)[index].keyword == Keyword::none) programs.push_back(index);
    if (programs.empty()) return -1;
    for (std::size_t n = 0; n < programs.size(); ++n) {
        const std::string_view from = (*this)[programs[n]].after.rest();
        const std::string_view behind =
            n + 1 < programs.size() ? (*this)[programs[n + 1]].at.rest() : std::string_view();
        const int code = last_end(from.substr(0, from.size() - behind.size()));
        if (code == 2 || code == 30) return programs[n];
        if (n == 0 && code != 99) break;
    }
    return programs.front();
}

}  // namespace tribo::readers::gcode
