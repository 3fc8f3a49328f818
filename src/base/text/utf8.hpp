// SPDX-License-Identifier: MIT
// Characters of UTF-8 (RFC 3629). Any thread.
#pragma once

#include <cstddef>
#include <string_view>

namespace tribo {

// Returns the number of bytes of the character at the start of `text`; 0 if there is none.
std::size_t utf8_bytes(std::string_view text);

// The code of the character at the start of `text`, which has `bytes` bytes: 1 to 4.
char32_t utf8_code(std::string_view text, std::size_t bytes);

}  // namespace tribo
