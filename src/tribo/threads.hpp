// SPDX-License-Identifier: MIT
// A thread pool as a ParallelFor.
#pragma once

#include "base/parallel.hpp"

namespace tribo {

inline constexpr int kMaxThreads = 256;

// Number of threads that this process may use.
int available_threads();

// A parallel loop over a pool of `threads` threads, including the caller; 1 gives a plain loop. The function
// object owns the pool.
ParallelFor parallel_for_over(int threads);

}  // namespace tribo
