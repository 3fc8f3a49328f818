// SPDX-License-Identifier: MIT
// Rooms create no threads: the owner of a thread pool passes its loop to the rooms as a ParallelFor.
#pragma once

#include <cstddef>
#include <functional>

namespace tribo {

// Calls body(0) ... body(count - 1), each once, in any order, possibly at the same time. Returns when all are
// done. A room may only pass bodies whose results do not depend on that order.
using ParallelFor = std::function<void(std::size_t count, const std::function<void(std::size_t)>& body)>;

// The loop on the calling thread.
inline void serial_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace tribo
