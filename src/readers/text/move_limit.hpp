// SPDX-License-Identifier: MIT
// How many moves a program may have.
#pragma once

#include <cstddef>
#include <string>

#include "base/result.hpp"

namespace tribo::readers {

// At 256 bytes each they take 2.6 GB.
inline constexpr std::size_t kMostMoves = 10'000'000;

// Refuses the move of this line, which is one more than `max_moves`.
inline std::unexpected<Error> refuse_more_moves(const std::string& source_name, int line,
                                                std::size_t max_moves) {
    return fail_at(source_name, line, 1, "the program has more than " + std::to_string(max_moves) + " moves",
                   max_moves < kMostMoves ? "split it, or allow more memory" : "split it");
}

}  // namespace tribo::readers
