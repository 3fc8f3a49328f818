// SPDX-License-Identifier: MIT
#include "readers/rewrite/word_search.hpp"

#include <algorithm>

#include "base/text/decimal.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kNowhere = std::string_view::npos;

// What stands behind the letter.
std::optional<NumberWord> word_behind(std::string_view line, std::size_t at, FeedLanguage language,
                                      char letter) {
    if (letter == 'F' && language == FeedLanguage::heidenhain && at < line.size()) {
        if (to_upper(line[at]) == 'Z' || to_upper(line[at]) == 'U') ++at;  // per tooth, per turn
        if (line.substr(at).starts_with("AUTO")) return NumberWord{at, at, 0, true};
    }
    while (at < line.size() && (line[at] == ' ' || line[at] == '\t')) ++at;
    if (language == FeedLanguage::siemens && at < line.size() && line[at] == '=') ++at;
    while (at < line.size() && line[at] == ' ') ++at;
    if (at >= line.size()) return std::nullopt;
    if (const auto number = number_at(line, at)) return number;
    const char c = to_upper(line[at]);
    const bool parameter =
        (c == 'Q' && language == FeedLanguage::heidenhain) || (c == 'R' && language == FeedLanguage::siemens);
    if (c == '#' || c == '[' || c == '(' || parameter) return NumberWord{at, at, 0, true};
    return std::nullopt;
}

// The F at `at` of a Klartext block is that of M128, M103 or M140 MB before it, and not of the path.
bool is_of_function(std::string_view line, std::size_t at) {
    std::string before(trimmed(line.substr(0, at)));
    std::ranges::transform(before, before.begin(), to_upper);
    const auto is_word = [&](std::size_t m) { return m == 0 || !is_letter(before[m - 1]); };
    for (const std::string_view name : {"M128", "M103"}) {
        if (before.ends_with(name) && is_word(before.size() - name.size())) return true;
    }
    const std::size_t m140 = before.rfind("M140");
    return m140 != kNowhere && is_word(m140) &&
           before.find_first_not_of(" \tMBAX+-.,0123456789", m140 + 4) == kNowhere;
}

}  // namespace

std::optional<NumberWord> number_at(std::string_view line, std::size_t at) {
    NumberWord word{at, at, 0, false};
    word.end = at + parse_decimal(line.substr(at), word.value, DecimalExponent::none);
    if (word.end == at) return std::nullopt;
    // A decimal comma.
    if (word.end + 1 < line.size() && line[word.end] == ',' && is_digit(line[word.end + 1])) {
        std::string text(line.substr(at));
        text[word.end - at] = '.';
        word.end = at + parse_decimal(text, word.value, DecimalExponent::none);
    }
    return word;
}

std::optional<NumberWord> word_in_block(std::string_view line, FeedLanguage language, char letter) {
    std::size_t depth = 0;
    for (std::size_t n = 0; n < line.size(); ++n) {
        const char c = line[n];
        if (c == ';') return std::nullopt;
        if (c == '"') {
            n = std::min(line.find('"', n + 1), line.size());
        } else if (c == '(' || c == '[') {
            ++depth;
        } else if (c == ')' || c == ']') {
            if (depth > 0) --depth;
        } else if (c == '<' && language == FeedLanguage::gcode) {
            n = std::min(line.find('>', n + 1), line.size());
        } else if (to_upper(c) == letter && depth == 0 &&
                   (n == 0 || !(is_letter(line[n - 1]) || line[n - 1] == '_'))) {
            const bool is_other =
                letter == 'F' && language == FeedLanguage::heidenhain && is_of_function(line, n);
            if (is_other) continue;
            if (auto word = word_behind(line, n + 1, language, letter)) return word;
        }
    }
    return std::nullopt;
}

std::optional<NumberWord> word_in_statement(std::string_view line, std::string_view name) {
    std::string text(line);
    std::ranges::transform(text, text.begin(), to_upper);
    const std::size_t word = text.find_first_not_of(" \t");
    if (word == kNowhere || text.compare(word, name.size(), name) != 0) return std::nullopt;
    const std::size_t slash = text.find('/', word);
    if (slash == kNowhere) return std::nullopt;
    for (std::size_t at = slash + 1; at < line.size();) {
        const std::size_t begin = line.find_first_not_of(" \t", at);
        if (begin == kNowhere) break;
        if (const auto number = number_at(line, begin)) return number;
        at = std::min(line.find(',', begin), line.size() - 1) + 1;
    }
    return NumberWord{slash + 1, slash + 1, 0, true};
}

}  // namespace tribo::readers
