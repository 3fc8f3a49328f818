// SPDX-License-Identifier: MIT
// A position in a line of G-code, shared by the readers of words, expressions and O-words.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::gcode {

struct Cursor {
    std::string_view line;
    std::size_t at = 0;
    int number = 0;  // line number, from 1
    const std::string* source_name = nullptr;

    // Returns the character at the position; 0 at the end of the line.
    char peek() const { return at < line.size() ? line[at] : '\0'; }
    void skip_blanks() {
        while (at < line.size() && is_blank(line[at])) ++at;
    }
    char peek_after_blanks() {
        skip_blanks();
        return peek();
    }
    // True when only a ';' comment is left.
    bool at_end() {
        const char c = peek_after_blanks();
        return c == '\0' ? at >= line.size() : c == ';';
    }
    std::unexpected<Error> refuse(std::size_t where, std::string cause, std::string remedy) const {
        return fail_at(*source_name, number, static_cast<int>(where) + 1, std::move(cause),
                       std::move(remedy));
    }
};

}  // namespace tribo::readers::gcode
