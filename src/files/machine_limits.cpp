// SPDX-License-Identifier: MIT
#include "files/machine_limits.hpp"

#include <time.h>

#include "files/memory.hpp"

namespace tribo::files {

job::LoadOptions machine_limits(std::uint64_t memory_bytes) {
    job::LoadOptions options;
    options.memory_bytes = memory_bytes > 0 ? memory_bytes : default_memory_budget_bytes();
    options.clock_s = [] {
        struct timespec used = {};
        ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
        return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
    };
    return options;
}

}  // namespace tribo::files
