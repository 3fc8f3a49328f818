// SPDX-License-Identifier: MIT
#include "tribo/threads.hpp"

#include <algorithm>
#include <memory>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <thread>

namespace tribo {

int available_threads() {
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMaxThreads);
}

ParallelFor parallel_for_over(int threads) {
    if (threads <= 1) return serial_for;
    auto arena = std::make_shared<tbb::task_arena>(threads);
    return [arena](std::size_t count, const std::function<void(std::size_t)>& body) {
        // Tasks of rooms take some microseconds or more: each goes to the next free thread.
        arena->execute([&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner{}); });
    };
}

}  // namespace tribo
