// SPDX-License-Identifier: MIT
#include "base/text/printable.hpp"

#include <algorithm>

#include "base/text/utf8.hpp"

namespace tribo {
namespace {

bool is_control(char32_t c) {
    return c < 0x20 || (c >= 0x7f && c < 0xa0);
}

bool changes_lines(char32_t c) {
    return c == 0x61c || c == 0x200e || c == 0x200f || (c >= 0x2028 && c <= 0x202e) ||
           (c >= 0x2066 && c <= 0x2069);
}

void append_hex(std::string& to, char kind, char32_t code, int digits) {
    constexpr std::string_view kHex = "0123456789abcdef";
    to += {'\\', kind};
    for (int n = digits - 1; n >= 0; --n) to += kHex[code >> static_cast<unsigned>(4 * n) & 0xfU];
}

}  // namespace

std::string printable(std::string_view text) {
    std::string shown;
    while (!text.empty()) {
        const std::size_t bytes = utf8_bytes(text);
        const char32_t code = bytes > 0 ? utf8_code(text, bytes) : static_cast<unsigned char>(text[0]);
        if (code == '\n') {
            shown += "\\n";
        } else if (code == '\t') {
            shown += "\\t";
        } else if (bytes == 0 || is_control(code)) {
            append_hex(shown, 'x', code, 2);
        } else if (changes_lines(code)) {
            append_hex(shown, 'u', code, 4);
        } else {
            shown += text.substr(0, bytes);
        }
        text.remove_prefix(std::max<std::size_t>(bytes, 1));
    }
    return shown;
}

}  // namespace tribo
