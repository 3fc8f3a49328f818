// SPDX-License-Identifier: MIT
// Available memory, and memory used by this process.
#pragma once

#include <cstdint>
#include <string>

namespace tribo::files {

// Returns the memory of the machine, or the limit of control groups (version 1 or 2) if it is smaller; bytes.
// 0: the system does not state it. `root`: root of the file tree with proc/ and sys/.
std::uint64_t available_memory_bytes(const std::string& root = "");

// Returns the peak memory of this process, bytes.
std::uint64_t peak_memory_bytes();

// Returns the memory limit of a run without --memory: half of the available memory, so that the machine stays
// usable.
std::uint64_t default_memory_budget_bytes();

}  // namespace tribo::files
