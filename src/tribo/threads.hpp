// SPDX-License-Identifier: MIT
// A pool of threads, handed to the rooms as a ParallelFor.
#pragma once

#include "base/parallel.hpp"

namespace tribo {

inline constexpr int kMaxThreads = 256;

// As many as this process may use at once.
int available_threads();

// Loops over a pool of `threads` threads (the caller is one of them); 1 gives the plain loop. The pool lives
// as long as the function object.
ParallelFor parallel_for_over(int threads);

}  // namespace tribo
