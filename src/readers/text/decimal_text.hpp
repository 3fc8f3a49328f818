// SPDX-License-Identifier: MIT
// Numbers to decimal text: the same characters on every system, no locale, no allocation beyond the string's.
#pragma once

#include <string>

namespace tribo::readers {

// Appends the value with exactly `decimals` digits after the point (0 to 15), rounded to nearest: -0.50. A
// value that rounds to zero has no sign. An absolute value from 1e15 on is written with an exponent:
// 1.25e+20. Values that are not finite give nan, inf or -inf.
void append_fixed(std::string& text, double value, int decimals);

// The same without trailing zeros: 0.5, 12, 3.1416.
std::string short_decimal(double value, int decimals = 4);

// The same of a length: 3.1416 mm.
std::string mm_text(double value);

}  // namespace tribo::readers
