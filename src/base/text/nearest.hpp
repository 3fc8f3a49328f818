// SPDX-License-Identifier: MIT
// Suggestions for a mistyped word: the nearest known word.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tribo {

// Returns the number of insertions, deletions, replacements and swaps of neighbours that turn one word into
// the other (Damerau 1964; the restricted form). Letter case is ignored.
int edit_distance(std::string_view a, std::string_view b);

// Returns the candidate with the least distance, the first of equal ones; empty without candidates.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

// True if the word may be a typing error or the beginning of the candidate.
bool is_close(std::string_view word, std::string_view candidate);

// Returns `try 'x'` for a close candidate, else `try one of a, b, c (nearest: 'b')`.
std::string suggestion(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace tribo
