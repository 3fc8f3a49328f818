// SPDX-License-Identifier: MIT
// Refuses TOML whose keys have so many parts that its tables would nest deeper than any stack.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::job {

// a.b.c has three. toml++ limits the nesting of values, not of keys, and goes down its tables by recursion.
inline constexpr int kMostKeyParts = 16;

// Looks at text outside of quotes and comments. Text that is no TOML may pass: the parser refuses it.
Result<void> check_key_parts(std::string_view text, const std::string& file);

}  // namespace tribo::job
