// SPDX-License-Identifier: MIT
// Pieces of the text of a block, for what puts other controls into the words of Fanuc.
#pragma once

#include <string>
#include <string_view>

namespace tribo::readers {

std::string upper(std::string_view text);
// Letters, digits and _.
bool is_name(char c);
bool all_digits(std::string_view text);  // at least one
// The text from a place on; none behind its end.
std::string_view from(std::string_view text, std::size_t at);
std::string_view digits_at(std::string_view text, std::size_t at);
// The name in letters of a program of Okuma that begins with this line, OCHCK; empty: none begins.
std::string program_name(std::string_view line);
// The line of Okuma without the blanks around = and between two operands: VC1 = VC2 + 1 is VC1=VC2+1.
// Comments stay as they are.
std::string without_blanks_of_formulas(std::string_view line);

}  // namespace tribo::readers
