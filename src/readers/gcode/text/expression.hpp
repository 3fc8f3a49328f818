// SPDX-License-Identifier: MIT
// Numbers as a program may write them: digits, #parameters, [expressions] and functions, with LinuxCNC's
// operators: ** before * / MOD before + - before EQ NE GT GE LT LE before AND OR XOR, each from left to
// right; angles in degrees. No allocation but for names and errors.
#pragma once

#include <optional>
#include <string>

#include "base/result.hpp"
#include "readers/gcode/cursor.hpp"
#include "readers/gcode/text/parameters.hpp"

namespace tribo::readers::gcode {

// Digits with at most one decimal point, blanks among them allowed, no sign; none where no digit or point
// stands. Refused with the column `start`.
Result<std::optional<double>> read_digits(Cursor& cursor, std::size_t start);

// A number, #parameter, [expression] or function with any signs before it.
Result<double> read_value(Cursor& cursor, const Parameters& parameters);

// Whether a value starts here that is more than signs and digits.
bool starts_computed_value(const Cursor& cursor);

// What follows '#': a number, itself perhaps computed, or a name in <>, given in lower case without blanks.
struct ParameterName {
    int number = 0;    // 0 where it has a name
    std::string name;  // empty where it has a number
};
Result<void> read_parameter_name(Cursor& cursor, const Parameters& parameters, ParameterName& read);

// The text between < and >, in lower case without blanks; the cursor stands on '<'.
Result<void> read_angled_name(Cursor& cursor, std::string& name);

}  // namespace tribo::readers::gcode
