// SPDX-License-Identifier: MIT
// Numbers of a program: digits, #parameters, [expressions] and functions, with the operators of LinuxCNC: **
// before * / MOD before + - before EQ NE GT GE LT LE before AND OR XOR, each from left to right. Angles are
// in degrees. Allocates only for names and errors.
#pragma once

#include <optional>
#include <string>

#include "base/result.hpp"
#include "readers/gcode/cursor.hpp"
#include "readers/gcode/text/parameters.hpp"

namespace tribo::readers::gcode {

// Reads digits with at most one decimal point, without sign; blanks among them are allowed. Returns none if
// no digit or point is at the cursor. Errors have the column of `start`.
Result<std::optional<double>> read_digits(Cursor& cursor, std::size_t start);

// Reads a number, #parameter, [expression] or function, with any signs before it.
Result<double> read_value(Cursor& cursor, const Parameters& parameters);

// True when the value at the cursor is more than signs and digits.
bool starts_computed_value(const Cursor& cursor);

// The name after '#': a number, which may be computed, or a name in <>, stored in lower case without blanks.
struct ParameterName {
    int number = 0;    // 0: it has a name
    std::string name;  // empty: it has a number
};
Result<void> read_parameter_name(Cursor& cursor, const Parameters& parameters, ParameterName& read);

// Reads the text between < and >, in lower case without blanks. The cursor must be on '<'.
Result<void> read_angled_name(Cursor& cursor, std::string& name);

}  // namespace tribo::readers::gcode
