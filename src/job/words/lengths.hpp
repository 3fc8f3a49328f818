// SPDX-License-Identifier: MIT
// Numbers and words of a short text that a user types: `ball 8 flutes 2`, `3 x 2 x 1/2 in`. Private to
// job/words.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace tribo::job {

enum class Unit { none, millimetre, inch, degree };

// A number with the unit behind it, or a word.
struct Item {
    std::string_view text;  // as written
    std::string word;       // lower case, without - and _; empty for a number
    double value = 0;
    Unit unit = Unit::none;

    bool is_number() const { return word.empty(); }
    double mm() const { return unit == Unit::inch ? 25.4 * value : value; }
};

// Splits at blanks, commas, semicolons, colons and '='; a number also ends a word (D6). Numbers may be
// fractions (1/4). The units are mm, in, inch, inches, ", deg, degrees. Refuses other characters and
// fractions of 0.
Result<std::vector<Item>> items_of(std::string_view text);

}  // namespace tribo::job
