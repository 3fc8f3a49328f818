// SPDX-License-Identifier: MIT
#include "readers/gcode/text/tool_comment.hpp"

#include <cmath>

#include "base/limits.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::gcode {
namespace {

// Takes a number from the front; none if the text does not start with one.
std::optional<double> take_number(std::string_view& text) {
    std::size_t length = 0;
    while (length < text.size() && (is_digit(text[length]) || text[length] == '.')) ++length;
    const auto number = number_of(text.substr(0, length));
    if (number) text.remove_prefix(length);
    return number;
}

bool take(std::string_view& text, std::string_view prefix) {
    text = trimmed(text);
    if (text.size() < prefix.size()) return false;
    for (std::size_t i = 0; i < prefix.size(); ++i) {
        if (to_upper(text[i]) != prefix[i]) return false;
    }
    text.remove_prefix(prefix.size());
    return true;
}

}  // namespace

std::optional<ToolComment> tool_in_comment(std::string_view comment) {
    if (!take(comment, "T")) return std::nullopt;
    const auto number = take_number(comment);
    if (!number || *number > kLimits.tool_number.range.max || *number != std::floor(*number))
        return std::nullopt;
    if (!take(comment, "D=")) return std::nullopt;
    const auto diameter = take_number(comment);
    if (!diameter || *diameter <= 0 || *diameter > kLimits.cutter_diameter.range.max) return std::nullopt;
    ToolComment tool{static_cast<int>(*number), *diameter, 0};
    if (take(comment, "CR=")) {
        const auto corner = take_number(comment);
        if (!corner || 2 * *corner > *diameter) return std::nullopt;
        tool.corner = *corner;
    }
    return tool;
}

}  // namespace tribo::readers::gcode
