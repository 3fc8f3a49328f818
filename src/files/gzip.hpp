// SPDX-License-Identifier: MIT
// Packed files (RFC 1952), known by their first bytes and not by their name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::files {

bool is_gzip(std::string_view bytes);

// What is packed, all members of it. Refused as soon as more than `limit_bytes` come out, so that a small
// file cannot take all memory.
Result<std::string> gunzip(std::string_view bytes, std::uint64_t limit_bytes, const std::string& source_name);

}  // namespace tribo::files
