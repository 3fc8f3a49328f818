// SPDX-License-Identifier: MIT
// Tokens that let somebody in: made so that nobody can guess them, compared so that nobody can feel for them.
#pragma once

#include <string>
#include <string_view>

namespace tribo::net {

// 128 bits from the system's generator (getentropy) as 32 hexadecimal digits.
std::string random_token();

// In a time that does not tell how much of it is right; only that the lengths differ may show.
bool same_secret(std::string_view a, std::string_view b);

}  // namespace tribo::net
