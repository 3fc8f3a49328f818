// SPDX-License-Identifier: MIT
#include "readers/siemens/text.hpp"

#include <algorithm>

#include "readers/siemens/formula.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::siemens {
namespace {

std::string word_at(std::string_view line, std::size_t at) {
    gcode::Cursor in;
    in.line = line;
    in.at = at;
    return name_at(in);
}

// True if the word stands in the code outside of texts.
bool has_jump(std::string_view code) {
    bool quoted = false;
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (code[i] == '"') quoted = !quoted;
        const bool begins =
            !quoted && to_upper(code[i]) == 'G' && (i == 0 || !is_name_character(code[i - 1]));
        if (begins && word_at(code, i).starts_with("GOTO")) return true;
    }
    return false;
}

// The name of "%_N_PART_MPF" and of "%PART"; the ending goes into `kind`.
std::string header_name(std::string_view line, std::string& kind) {
    std::string name;
    for (const char c : line.substr(line.find('%') + 1)) {
        if (!is_name_character(c)) break;
        name += to_upper(c);
    }
    if (name.starts_with("_N_")) name.erase(0, 3);
    for (const std::string_view ending : {"_MPF", "_SPF"}) {
        if (!name.ends_with(ending)) continue;
        kind = ending;
        name.erase(name.size() - ending.size());
    }
    return name;
}

constexpr std::string_view kBegins[] = {"IF", "WHILE", "FOR", "LOOP", "REPEAT"};
constexpr std::string_view kEnds[] = {"ENDIF", "ENDWHILE", "ENDFOR", "ENDLOOP", "UNTIL"};

}  // namespace

Head head_of(std::string_view line) {
    Head head;
    std::size_t i = 0;
    const auto skip = [&] {
        while (i < line.size() && is_blank(line[i])) ++i;
    };
    skip();
    if (i < line.size() && line[i] == '/') {
        head.is_deletable = true;
        ++i;
        if (i < line.size() && is_digit(line[i])) ++i;
        skip();
    }
    const bool has_number =
        i + 1 < line.size() && (to_upper(line[i]) == 'N' || line[i] == ':') && is_digit(line[i + 1]);
    if (has_number) {
        head.number = line[i] == ':' ? ":" : "N";
        std::size_t end = i + 1;
        while (end < line.size() && is_digit(line[end])) head.number += line[end++];
        i = end;
        skip();
    }
    const std::string word = word_at(line, i);
    if (!word.empty()) {
        std::size_t end = i + word.size();
        while (end < line.size() && is_blank(line[end])) ++end;
        const bool is_label =
            end < line.size() && line[end] == ':' && !(end + 1 < line.size() && line[end + 1] == '=');
        if (is_label) {
            head.label = word;
            i = end + 1;
            skip();
        }
    }
    head.at = i;
    return head;
}

std::string_view code_of(std::string_view line) {
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') quoted = !quoted;
        if (line[i] == ';' && !quoted) return line.substr(0, i);
    }
    // A text that does not close: the first ';' ends the code.
    return quoted ? line.substr(0, line.find(';')) : line;
}

Text::Text(std::string_view bytes) {
    TextLines lines(bytes);
    while (const auto line = lines.next()) lines_.push_back(*line);
    units_.emplace_back();
    std::vector<std::size_t> open;
    bool has_content = false;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const std::string_view code = code_of(lines_[i]);
        const Head head = head_of(code);
        if (!head.number.empty()) places_[head.number].push_back(i);
        if (!head.label.empty()) places_[head.label].push_back(i);
        if (head.at >= code.size()) continue;
        const bool is_header =
            code[head.at] == '%' && code.size() > head.at + 1 && is_name_character(code[head.at + 1]);
        const std::string word = word_at(code, head.at);
        const bool is_proc = word == "PROC";
        if ((is_header || is_proc) && has_content) {
            units_.back().end = i;
            units_.emplace_back();
            units_.back().begin = i;
            has_content = false;
            open.clear();
        }
        Unit& unit = units_.back();
        if (is_header) {
            std::string kind;
            unit_names_.try_emplace(header_name(code, kind), units_.size() - 1);
            unit.is_subprogram = kind == "_SPF";
        } else if (is_proc) {
            std::size_t at = head.at + 4;
            while (at < code.size() && is_blank(code[at])) ++at;
            unit_names_.try_emplace(word_at(code, at), units_.size() - 1);
            unit.proc = i;
            has_content = true;
        } else {
            has_content = true;
            find_structure(i, code, word, open);
        }
    }
    units_.back().end = lines_.size();
    while (main_ < units_.size() && (units_[main_].is_subprogram || units_[main_].proc)) ++main_;
    if (main_ == units_.size()) main_ = 0;
}

void Text::find_structure(std::size_t i, std::string_view code, const std::string& word,
                          std::vector<std::size_t>& open) {
    const std::size_t after = head_of(code).at + word.size();
    const bool begins = std::find(std::begin(kBegins), std::end(kBegins), word) != std::end(kBegins) &&
                        !(word == "IF" && has_jump(code)) &&
                        !(word == "REPEAT" && code.find_first_not_of(" \t", after) != std::string_view::npos);
    const bool ends = std::find(std::begin(kEnds), std::end(kEnds), word) != std::end(kEnds);
    if ((ends || word == "ELSE") && !open.empty()) {
        partners_[open.back()] = i;
        partners_[i] = open.back();
        open.pop_back();
    }
    if (begins || word == "ELSE") open.push_back(i);
}

const Unit* Text::unit_named(const std::string& name) const {
    const auto found = unit_names_.find(name);
    return found == unit_names_.end() ? nullptr : &units_[found->second];
}

std::optional<std::size_t> Text::partner(std::size_t line) const {
    const auto found = partners_.find(line);
    if (found == partners_.end()) return std::nullopt;
    return found->second;
}

std::optional<std::size_t> Text::place_of(const std::string& label, std::size_t from, Way way,
                                          const Unit& unit) const {
    const auto found = places_.find(label);
    if (found == places_.end()) return std::nullopt;
    const std::vector<std::size_t>& lines = found->second;
    if (way != Way::backward) {
        const auto next = std::upper_bound(lines.begin(), lines.end(), from);
        if (next != lines.end() && *next < unit.end) return *next;
        if (way == Way::forward) return std::nullopt;
    }
    const auto after = std::upper_bound(lines.begin(), lines.end(), from);
    if (after == lines.begin() || *std::prev(after) < unit.begin) return std::nullopt;
    return *std::prev(after);
}

}  // namespace tribo::readers::siemens
