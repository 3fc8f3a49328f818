// SPDX-License-Identifier: MIT
#include "readers/tools/folded_text.hpp"

#include <cstddef>

#include "base/text/utf8.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

// The letters of Latin-1 from 0xC0 on, without accents. '?' has none.
constexpr std::string_view kLatin1 = "AAAAAAACEEEEIIIIDNOOOOO*?UUUUYTSAAAAAAACEEEEIIIIDNOOOOO/?UUUUYTY";

// Appends a character of Unicode.
void append_folded(std::string& out, char32_t code) {
    switch (code) {
        case 0xB0:  // degree
        case 0xBA:  // ordinal, typed as a degree sign
            out += " DEG ";
            return;
        case 0xD8:  // O with stroke, typed as a diameter sign
        case 0xF8:
        case 0x3A6:  // phi
        case 0x3C6:
        case 0x2300:  // diameter
        case 0x2205:  // empty set
            out += " DIA ";
            return;
        case 0x201C:  // quotation marks and double prime
        case 0x201D:
        case 0x2033:
            out += '"';
            return;
        case 0x2010:  // hyphens, dashes and minus
        case 0x2011:
        case 0x2012:
        case 0x2013:
        case 0x2014:
        case 0x2212:
            out += '-';
            return;
        case 0xA0:
            out += ' ';
            return;
        default:
            out += code >= 0xC0 && code <= 0xFF ? kLatin1[code - 0xC0] : '?';
    }
}

}  // namespace

std::string folded(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        if (static_cast<unsigned char>(text[at]) < 0x80) {
            out += to_upper(text[at++]);
        } else {
            // A byte that begins no character of UTF-8 is one of Latin-1.
            const std::size_t bytes = utf8_bytes(text.substr(at));
            append_folded(out, bytes > 0 ? utf8_code(text.substr(at), bytes)
                                         : static_cast<char32_t>(static_cast<unsigned char>(text[at])));
            at += bytes > 0 ? bytes : 1;
        }
    }
    return out;
}

}  // namespace tribo::readers
