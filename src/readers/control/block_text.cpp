// SPDX-License-Identifier: MIT
#include "readers/control/block_text.hpp"

#include <algorithm>

#include "readers/text/text_lines.hpp"

namespace tribo::readers {

std::string upper(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), to_upper);
    return out;
}

bool is_name(char c) {
    return is_letter(c) || is_digit(c) || c == '_';
}

bool all_digits(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

std::string_view from(std::string_view text, std::size_t at) {
    return text.substr(std::min(at, text.size()));
}

std::string_view digits_at(std::string_view text, std::size_t at) {
    const std::string_view rest = from(text, at);
    return rest.substr(0, std::min(rest.find_first_not_of("0123456789"), rest.size()));
}

std::string program_name(std::string_view line) {
    const auto end = std::find_if_not(line.begin(), line.end(), is_name);
    std::string name(line.begin(), end);
    const std::string_view rest = trimmed(from(line, name.size()));
    const bool is_alone = rest.empty() || rest.starts_with('(');
    if (!is_alone || name.size() < 2 || name[0] != 'O' || !is_letter(name[1])) name.clear();
    return name;
}

std::string without_blanks_of_formulas(std::string_view line) {
    const std::string_view block = line.substr(0, line.find('('));
    std::string out;
    for (std::size_t at = 0; at < block.size(); ++at) {
        const std::size_t next = std::min(block.find_first_not_of(" \t", at), block.size());
        const bool has_blank = next > at;
        const char c = next < block.size() ? block[next] : ' ';
        const bool blank_follows = next + 1 < block.size() && is_blank(block[next + 1]);
        const bool joins = c == '=' || (has_blank && blank_follows &&
                                        (c == '+' || c == '-' || c == '*' || (c == '/' && !out.empty())));
        if (!joins) {
            out += block[at];
            continue;
        }
        out += c;
        at = std::min(block.find_first_not_of(" \t", next + 1), block.size()) - 1;
    }
    return out + std::string(line.substr(block.size()));
}

}  // namespace tribo::readers
