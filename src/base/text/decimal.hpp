// SPDX-License-Identifier: MIT
// Decimal text to double and back: correctly rounded, the same bits everywhere, independent of the locale. No
// exceptions; only format_decimal allocates. Any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tribo {

// Says if an `e` after the digits starts an exponent. In G-code it does not: X10E5 are two words.
enum class DecimalExponent { allowed, none };

// Reads the number at the start of `text`: [+-] digits [. digits] [e [+-] digits], where one side of the
// point may be empty but not both ("1.", ".5", "+3", "-0.5e-3"). An `e` without digits is not read. Returns
// the number of characters read. Returns 0 without changing `value` if no number starts here. No leading
// blanks, no "inf", "nan" or hexadecimal. A size above the range gives infinity, which the caller refuses; a
// size below it gives 0.
std::size_t parse_decimal(std::string_view text, double& value,
                          DecimalExponent exponent = DecimalExponent::allowed);

// Returns the shortest text that parse_decimal reads back to the same double ("0.1", "-3", "1e+23"); for a
// float, to the same float.
std::string format_decimal(double value);
std::string format_decimal(float value);
// Rounded to so many significant digits: "0.12", "1300"; no exponent from 1 up to ten million.
std::string format_digits(double value, int digits);
void append_decimal(std::string& text, double value);
void append_decimal(std::string& text, float value);

}  // namespace tribo
