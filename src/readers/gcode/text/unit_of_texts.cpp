// SPDX-License-Identifier: MIT
#include "readers/gcode/text/unit_of_texts.hpp"

#include <algorithm>

#include "readers/text/text_lines.hpp"
#include "readers/tools/tool_list.hpp"
#include "readers/tools/tool_text.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr std::size_t kLookedAt = 1 << 16;  // only this many characters from the start are read
constexpr double kInchMm = 25.4;

// G20, G021, G70.
bool states_unit(std::string_view code) {
    for (std::size_t at = 0; at < code.size(); ++at) {
        if (to_upper(code[at]) != 'G') continue;
        std::size_t begin = at + 1;
        while (begin < code.size() && (is_blank(code[begin]) || code[begin] == '0')) ++begin;
        std::size_t end = begin;
        while (end < code.size() && is_digit(code[end])) ++end;
        const std::string_view number = code.substr(begin, end - begin);
        const bool is_whole = end == code.size() || code[end] != '.';
        if (is_whole && (number == "20" || number == "21" || number == "70" || number == "71")) return true;
    }
    return false;
}

}  // namespace

bool is_in_inches_by_texts(std::string_view bytes) {
    TextLines lines(bytes.substr(0, kLookedAt));
    bool has_inches = false;
    while (const auto line = lines.next()) {
        for (std::size_t at = 0; at < line->size();) {
            const std::size_t open = std::min(line->find_first_of("(;", at), line->size());
            if (states_unit(line->substr(at, open - at))) return false;
            if (open == line->size()) break;
            const bool is_bracket = (*line)[open] == '(';
            const std::size_t close =
                is_bracket ? std::min(line->find(')', open), line->size()) : line->size();
            for (const std::string_view text : texts_of_tools(line->substr(open + 1, close - open - 1))) {
                const ToolText tool = read_tool_text(text);
                if (!tool.describes_tool()) continue;
                if (tool.diameter->unit_mm == 1) return false;
                has_inches = has_inches || tool.diameter->unit_mm == kInchMm;
            }
            at = close + 1;
        }
    }
    return has_inches;
}

}  // namespace tribo::readers::gcode
