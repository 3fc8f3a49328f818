// SPDX-License-Identifier: MIT
// Access tokens: random, and compared in constant time.
#pragma once

#include <string>
#include <string_view>

namespace tribo::net {

// 128 bits from the system's generator (getentropy) as 32 hexadecimal digits.
std::string random_token();

// Compares in constant time: the duration shows only whether the lengths differ.
bool same_secret(std::string_view a, std::string_view b);

}  // namespace tribo::net
