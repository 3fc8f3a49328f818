// SPDX-License-Identifier: MIT
// How many moves a program may have, and which memory they take.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/result.hpp"
#include "motion/path/program.hpp"

namespace tribo::readers {

// At 256 bytes each they take 2.6 GB.
inline constexpr std::size_t kMostMoves = 10'000'000;
// A move, and its copies in vectors that grow and in the setup of a cut.
inline constexpr std::uint64_t kMoveBytes = 3 * sizeof(motion::Move);

// Number of moves that fit into the memory.
inline std::size_t most_moves(std::uint64_t memory_bytes) {
    return static_cast<std::size_t>(std::min<std::uint64_t>(kMostMoves, memory_bytes / kMoveBytes));
}

// Refuses the move of this line, which is one more than `max_moves`.
inline std::unexpected<Error> refuse_more_moves(const std::string& source_name, int line,
                                                std::size_t max_moves) {
    return fail_at(source_name, line, 1, "the program has more than " + std::to_string(max_moves) + " moves",
                   max_moves < kMostMoves ? "split it, or allow more memory" : "split it");
}

}  // namespace tribo::readers
