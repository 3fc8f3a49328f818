// SPDX-License-Identifier: MIT
#include "files/machine_limits.hpp"

#include <chrono>

#include "files/memory.hpp"

namespace tribo::files {

job::LoadOptions machine_limits(std::uint64_t memory_bytes) {
    job::LoadOptions options;
    options.memory_bytes = memory_bytes > 0 ? memory_bytes : default_memory_budget_bytes();
    options.clock_s = [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
    return options;
}

}  // namespace tribo::files
