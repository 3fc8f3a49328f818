// SPDX-License-Identifier: MIT
#include "base/text/json_string.hpp"

#include <algorithm>

#include "base/text/utf8.hpp"

namespace tribo {
void append_json_string(std::string& to, std::string_view text) {
    constexpr std::string_view kHex = "0123456789abcdef", kReplacement = "\xef\xbf\xbd";
    to += '"';
    while (!text.empty()) {
        const std::size_t bytes = utf8_bytes(text);
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
