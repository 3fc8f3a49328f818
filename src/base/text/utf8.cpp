// SPDX-License-Identifier: MIT
#include "base/text/utf8.hpp"

namespace tribo {

std::size_t utf8_bytes(std::string_view text) {
    const auto byte = [&](std::size_t n) {
        return n < text.size() ? static_cast<unsigned char>(text[n]) : 0U;
    };
    const auto goes_on = [&](std::size_t n) { return (byte(n) & 0xc0U) == 0x80U; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
    if (first < 0xc2 || first > 0xf4 || !goes_on(1)) return 0;
    if (first < 0xe0) return 2;
    // Refuses overlong forms, surrogates, and codes beyond the last character.
    if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0) ||
        (first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90) || !goes_on(2)) {
        return 0;
    }
    if (first < 0xf0) return 3;
    return goes_on(3) ? 4 : 0;
}

char32_t utf8_code(std::string_view text, std::size_t bytes) {
    const auto bits = [&](std::size_t n) { return static_cast<unsigned char>(text[n]) & 0x3fU; };
    const auto first = static_cast<unsigned char>(text[0]);
    if (bytes == 1) return first;
    char32_t code = first & (0x7fU >> bytes);
    for (std::size_t n = 1; n < bytes; ++n) code = code << 6U | bits(n);
    return code;
}

}  // namespace tribo
