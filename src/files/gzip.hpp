// SPDX-License-Identifier: MIT
// Compressed files (RFC 1952), detected by their first bytes and not by their name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::files {

bool is_gzip(std::string_view bytes);

// Returns the unpacked contents of all members. Refuses as soon as there are more than `limit_bytes`, so that
// a small file cannot use all memory.
Result<std::string> gunzip(std::string_view bytes, std::uint64_t limit_bytes, const std::string& source_name);

}  // namespace tribo::files
