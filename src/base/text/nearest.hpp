// SPDX-License-Identifier: MIT
// What somebody probably meant: the known word nearest to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tribo {

// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other (Damerau
// 1964; the restricted form), letter case counted as no difference.
int edit_distance(std::string_view a, std::string_view b);

// The candidate with the least distance, the earliest of equals; empty without candidates.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

// True for what may be a slip of the keyboard, or a beginning of the candidate.
bool is_close(std::string_view word, std::string_view candidate);

// `try 'x'` for a close candidate, `try one of a, b, c (nearest: 'b')` where none is close.
std::string suggestion(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace tribo
