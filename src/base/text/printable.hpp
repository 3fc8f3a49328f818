// SPDX-License-Identifier: MIT
// Text of others for a terminal: a name can hold bytes that move the cursor, recolour or reverse what stands
// there.
#pragma once

#include <string>
#include <string_view>

namespace tribo {

// Writes control characters as \n, \t or \x1b, characters that change the direction or end the line (Unicode
// 15, Bidi_Control, Zl, Zp) as \u202e, and bytes that are not UTF-8 as \xff. All other text stays. Any
// thread.
std::string printable(std::string_view text);

}  // namespace tribo
