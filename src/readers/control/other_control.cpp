// SPDX-License-Identifier: MIT
#include "readers/control/other_control.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "readers/control/fadal_words.hpp"
#include "readers/control/num_words.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kLookedAt = 1 << 16;  // only this many characters from the start are read

bool starts_with_digit(std::string_view text) {
    return !text.empty() && is_digit(text[0]);
}

// G81 G99 X5 Y0 Z2 I-20: a cycle with its depth as I, and no level R, which other controls need beside it.
bool is_cycle_of_fagor(std::string_view block) {
    const auto has = [&](char letter) { return block.find(letter) != std::string_view::npos; };
    const std::size_t at = block.find("G8");
    if (at == std::string_view::npos || at + 2 >= block.size()) return false;
    const char kind = block[at + 2];
    return kind >= '1' && kind <= '9' && kind != '3' && has('I') && has('Z') && !has('R') && !has('Q') &&
           !has('J') && !has('(') && !has('#') && !has('=');
}

}  // namespace

std::string_view name_of(OtherControl control) {
    constexpr std::array<std::string_view, kOtherControls> names{"Okuma OSP", "Fagor 8055", "NUM", "Fadal"};
    return names[static_cast<std::size_t>(control)];
}

std::optional<OtherControl> detect_other_control(std::string_view bytes) {
    TextLines lines(bytes.substr(0, kLookedAt));
    for (int number = 1; const auto line = lines.next(); ++number) {
        std::string text;
        for (const char c : *line) {
            if (c == ';') break;
            if (!is_blank(c)) text += to_upper(c);
        }
        std::string_view block = text;
        const bool is_first = number == 1;
        if (is_first && block.starts_with('$') && block.ends_with(".MIN%")) return OtherControl::okuma;
        if (is_first && block.starts_with('%') && block.find(",MX") != std::string_view::npos)
            return OtherControl::fagor;
        if (block.starts_with('N')) {
            block.remove_prefix(std::min(block.find_first_not_of("0123456789", 1), block.size()));
        }
        for (const std::string_view begin : {"(P", "(IFP", "(IF(P"}) {
            if (!block.starts_with(begin)) continue;
            const std::string_view rest = block.substr(begin.size());
            const std::size_t end = std::min(rest.find_first_not_of("0123456789"), rest.size());
            const bool is_assigned = rest.substr(end).starts_with('=');
            if (end > 0 && (begin != "(P" || is_assigned)) return OtherControl::fagor;
        }
        if (is_cycle_of_fagor(block)) return OtherControl::fagor;
        if (block.starts_with("(RPTN") || block.starts_with("(GOTON")) return OtherControl::fagor;
        if (block.starts_with("VC") && block.find('=') != std::string_view::npos &&
            starts_with_digit(block.substr(2)))
            return OtherControl::okuma;
        if (block.starts_with("CALLO") || block.starts_with("NCYL") || block.starts_with("G15H") ||
            block.starts_with("G56HA"))
            return OtherControl::okuma;
        if (is_block_of_num(text.substr(0, text.find('(')))) return OtherControl::num;
    }
    if (looks_like_fadal(bytes.substr(0, kLookedAt))) return OtherControl::fadal;
    return std::nullopt;
}

}  // namespace tribo::readers
