// SPDX-License-Identifier: MIT
// DIN/ISO programs of Heidenhain controls (%NAME G71 *) in conversational words. What has no such word is
// left as it is, and the reader of conversational programs refuses it by its line.
#pragma once

#include <string>
#include <string_view>

namespace tribo::readers {

// Separates blocks that one line of DIN/ISO became.
inline constexpr char kNextBlock = '\v';

// True if the first block is %NAME with G70 or G71.
bool looks_like_din_iso(std::string_view bytes);

// Has as many lines as the program.
std::string in_conversational_words(std::string_view bytes);

}  // namespace tribo::readers
