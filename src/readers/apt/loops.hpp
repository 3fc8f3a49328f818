// SPDX-License-Identifier: MIT
// The words of loops and jumps in APT.
#pragma once

#include <string>
#include <string_view>

#include "readers/apt/lexer.hpp"

namespace tribo::readers::apt {

// In upper case, without blanks around it.
std::string upper(std::string_view text);
// The statement as it was written: its word, a slash, its items.
std::string whole(const Statement& statement);
// True for JUMPTO and IF.
bool is_jump(std::string_view word);
// The label before a statement, as in A1) GOTO/1,2,3, in upper case. Empty: none. Takes it from the word.
std::string take_label(Statement& statement);

}  // namespace tribo::readers::apt
