// SPDX-License-Identifier: MIT
// The SHA-256 of bytes (FIPS 180-4), as sha256sum prints it.
#pragma once

#include <string>
#include <string_view>

namespace tribo::files {

// 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace tribo::files
