// SPDX-License-Identifier: MIT
#include "readers/tools/tool_list.hpp"

#include <algorithm>
#include <set>

#include "readers/text/text_lines.hpp"

namespace tribo::readers {

std::vector<std::string_view> texts_of_tools(std::string_view text) {
    std::vector<std::size_t> begins, ends;  // of each number that begins an item, from its T
    std::set<std::string_view> numbers;
    for (std::size_t at = 0; at + 1 < text.size(); ++at) {
        if (to_upper(text[at]) != 'T' || !is_digit(text[at + 1])) continue;
        std::size_t before = at;
        while (before > 0 && is_blank(text[before - 1])) --before;
        const bool begins_item = before == 0 || before < at ||
                                 std::string_view(",;/|:(+&").find(text[before - 1]) != std::string::npos;
        std::size_t end = at + 1;
        while (end < text.size() && is_digit(text[end])) ++end;
        if (!begins_item || (end < text.size() && is_letter(text[end]))) continue;
        begins.push_back(at);
        ends.push_back(end);
        numbers.insert(text.substr(at + 1, end - at - 1));
    }
    if (numbers.size() < 2) return {text};
    // 10MM MILL T1, 6MM DRILL T2: the number ends its item.
    const bool ends_item =
        std::ranges::none_of(text.substr(ends.back()), [](char c) { return is_letter(c) || is_digit(c); });
    std::vector<std::string_view> parts;
    for (std::size_t i = 0; i < begins.size(); ++i) {
        const bool is_first = i == 0, is_last = i + 1 == begins.size();
        const std::size_t begin = !ends_item ? begins[i] : is_first ? 0 : ends[i - 1];
        const std::size_t end = ends_item ? ends[i] : is_last ? text.size() : begins[i + 1];
        std::string_view part = text.substr(begin, end - begin);
        while (!part.empty() && std::string_view(" ,;/|-").find(part.back()) != std::string_view::npos)
            part.remove_suffix(1);
        parts.push_back(part);
    }
    return parts;
}

}  // namespace tribo::readers
