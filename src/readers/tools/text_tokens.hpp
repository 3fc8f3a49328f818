// SPDX-License-Identifier: MIT
// Words, numbers with their units, and signs of a folded text about tools. Any thread; allocates.
#pragma once

#include <string_view>
#include <vector>

namespace tribo::readers {

struct TextToken {
    enum class Kind { word, number, sign };
    Kind kind = Kind::sign;
    std::string_view text;    // of the folded text
    bool is_glued = false;    // no blank stands before it
    double value = 0;         // of a number
    double unit_mm = 0;       // of a number with a unit of length; else 0
    bool is_angle = false;    // a number in degrees
    bool is_integer = false;  // written without a point, and no fraction

    bool is_word(std::string_view word) const { return kind == Kind::word && text == word; }
    bool is_sign(char c) const { return kind == Kind::sign && text.starts_with(c); }
    bool is_number() const { return kind == Kind::number; }
    // A number that may count things or name a tool.
    bool is_count() const { return is_number() && is_integer && unit_mm == 0 && !is_angle; }
};

// Reads 6, 6., .5, 0.25, 6,5 (a decimal comma between digits), 1/4, 1-1/2 and 1 1/2 (fractions are inches),
// each with mm, cm, in, inch, ", deg. Signs are single characters; a minus is a sign. `folded_text` must
// outlive the tokens.
std::vector<TextToken> tokens_of(std::string_view folded_text);

}  // namespace tribo::readers
