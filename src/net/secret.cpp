// SPDX-License-Identifier: MIT
#include "net/secret.hpp"

#include <array>
#include <cstdlib>
#include <unistd.h>

namespace tribo::net {

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    // It fails only if the kernel does not have this call. A token that can be guessed would be worse than an
    // end of the program.
    if (::getentropy(bytes.data(), bytes.size()) != 0) std::abort();
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (const unsigned char byte : bytes) {
        text += kDigits[byte >> 4];
        text += kDigits[byte & 15];
    }
    return text;
}

bool same_secret(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned differ = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
        differ |= static_cast<unsigned char>(a[n]) ^ static_cast<unsigned char>(b[n]);
    return differ == 0;
}

}  // namespace tribo::net
