// SPDX-License-Identifier: MIT
// Numbers of a program: digits, #parameters, [expressions] and functions, with the operators of LinuxCNC: **
// before * / MOD before + - before EQ NE GT GE LT LE before AND OR XOR, each from left to right. Angles are
// in degrees. Allocates only for names and errors. A vacant variable of a Fanuc control is not a number: it
// equals only another one, and counts as 0 in formulas. On Fanuc and Haas controls AND OR XOR combine the
// bits of whole numbers; AND has the rank of *, OR and XOR that of +. There MOD keeps the sign of the first
// number, FIX and FUP go towards zero and away from it, and ATAN gives 0 to 360.
#pragma once

#include <optional>
#include <string>

#include "base/result.hpp"
#include "readers/gcode/cursor.hpp"
#include "readers/gcode/text/digits.hpp"
#include "readers/gcode/text/parameters.hpp"

namespace tribo::readers::gcode {

// Reads a number, #parameter, [expression] or function, with any signs before it. Not a number: a vacant
// variable. ROUND gives a multiple of `round_to`.
Result<double> read_value(Cursor& cursor, const Parameters& parameters, double round_to = 1);

// The same with operators that no brackets enclose: what follows '=' on a Fanuc control.
Result<double> read_formula(Cursor& cursor, const Parameters& parameters);

// True when the value at the cursor is more than signs and digits.
bool starts_computed_value(const Cursor& cursor);

// The name after '#': a number, which may be computed, or a name in <>, stored in lower case without blanks.
struct ParameterName {
    int number = 0;    // if it has no name
    std::string name;  // empty: it has a number
};
Result<void> read_parameter_name(Cursor& cursor, const Parameters& parameters, ParameterName& read);

}  // namespace tribo::readers::gcode
