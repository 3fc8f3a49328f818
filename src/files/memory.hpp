// SPDX-License-Identifier: MIT
// How much memory there is to take, and how much was taken.
#pragma once

#include <cstdint>
#include <string>

namespace tribo::files {

// The machine's memory or, where control groups (version 1 or 2) allow this process less, that limit; bytes.
// 0 where the system does not tell. `root` is the root of the file tree that holds proc/ and sys/.
std::uint64_t available_memory_bytes(const std::string& root = "");

// The most memory that this process has held at once, bytes.
std::uint64_t peak_memory_bytes();

// What a run may take unless --memory says otherwise: half of what there is, so that the machine stays
// usable.
std::uint64_t default_memory_budget_bytes();

}  // namespace tribo::files
