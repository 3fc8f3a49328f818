// SPDX-License-Identifier: MIT
#include "base/text/json_string.hpp"

#include <algorithm>

namespace tribo {
namespace {

// Returns the number of bytes of the UTF-8 character at the start of `text`; 0 if there is none (RFC 3629).
std::size_t character_bytes(std::string_view text) {
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

}  // namespace

void append_json_string(std::string& to, std::string_view text) {
    constexpr std::string_view kHex = "0123456789abcdef", kReplacement = "\xef\xbf\xbd";
    to += '"';
    while (!text.empty()) {
        const std::size_t bytes = character_bytes(text);
        const char c = text[0];
        const auto code = static_cast<unsigned char>(c);
        if (bytes == 0) {
            to += kReplacement;
        } else if (c == '"' || c == '\\') {
            to += {'\\', c};
        } else if (code < 0x20) {
            to += {'\\', 'u', '0', '0', kHex[code / 16U], kHex[code % 16U]};
        } else {
            to += text.substr(0, bytes);
        }
        text.remove_prefix(std::max<std::size_t>(bytes, 1));
    }
    to += '"';
}

}  // namespace tribo
