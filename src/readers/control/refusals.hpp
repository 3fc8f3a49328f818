// SPDX-License-Identifier: MIT
// All refusals of a program at once, where the caller wants them.
#pragma once

#include <vector>

#include "base/result.hpp"

namespace tribo::readers {

// More refusals of one program are not shown.
inline constexpr std::size_t kMostRefusals = 20;

// Keeps a refusal, each cause once. Returns true if the reading may go on without the refused block; false if
// the caller wants the first alone (null), or the list is full.
bool keep_refusal(std::vector<Error>* refusals, const Error& error);

// The first of the refusals that were kept, else null.
const Error* first_refusal(const std::vector<Error>* refusals);

}  // namespace tribo::readers
