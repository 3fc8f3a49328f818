// SPDX-License-Identifier: MIT
// How often a test program has allocated, where one of its sources includes counted_allocations.hpp.
#pragma once

#include <atomic>

namespace tribo::test {

inline std::atomic<long> allocations{0};

}  // namespace tribo::test
