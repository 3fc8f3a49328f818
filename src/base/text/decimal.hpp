// SPDX-License-Identifier: MIT
// Decimal text to double and back: correctly rounded, the same bits everywhere, blind to the locale. No
// exception; only format_decimal allocates. Any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tribo {

// Whether an `e` after the digits starts an exponent. In G-code it does not: X10E5 are two words.
enum class DecimalExponent { allowed, none };

// Reads the number that `text` starts with: [+-] digits [. digits] [e [+-] digits], where either side of the
// point may be empty but not both ("1.", ".5", "+3", "-0.5e-3"). An `e` without digits is left unread. Gives
// the number of characters read, or 0, leaving `value` alone, where none starts here. No leading blanks, no
// "inf", "nan" or hexadecimal. A size above the range gives infinity, which the caller refuses; one below, 0.
std::size_t parse_decimal(std::string_view text, double& value,
                          DecimalExponent exponent = DecimalExponent::allowed);

// The shortest text that parse_decimal reads back to the same double ("0.1", "-3", "1e+23"); of a float, to
// the same float.
std::string format_decimal(double value);
std::string format_decimal(float value);
void append_decimal(std::string& text, double value);
void append_decimal(std::string& text, float value);

}  // namespace tribo
