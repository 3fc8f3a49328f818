// SPDX-License-Identifier: MIT
// What loading a job may take on this machine.
#pragma once

#include <cstdint>

#include "job/loader.hpp"

namespace tribo::files {

// Returns options with so much memory, bytes (0: default_memory_budget_bytes()), and with the processor time
// of the calling thread as clock: other programs do not make a loop endless.
job::LoadOptions machine_limits(std::uint64_t memory_bytes = 0);

}  // namespace tribo::files
