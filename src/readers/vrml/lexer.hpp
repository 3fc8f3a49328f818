// SPDX-License-Identifier: MIT
// Words of VRML 2.0 text (ISO/IEC 14772-1, 4.3 and annex A).
#pragma once

#include <cstdint>
#include <string_view>

namespace tribo::readers {

enum class VrmlTokenKind : std::uint8_t {
    end,
    word,
    number,
    string,
    open_brace,
    close_brace,
    open_bracket,
    close_bracket,
    too_long,     // longer than kMaxToken
    unterminated  // a string without its closing quote
};

struct VrmlToken {
    VrmlTokenKind kind = VrmlTokenKind::end;
    std::string_view text;  // as written; a string without quotes, with its escapes
    double number = 0;      // infinite if the text is too large a number
    int line = 1, column = 1;
    std::uint32_t offset = 0;  // of the first byte

    bool is(std::string_view word) const { return kind == VrmlTokenKind::word && text == word; }
};

// Commas are blanks, and `#` starts a comment to the end of the line. Any other run of bytes is a word (names
// in real files contain dots, plus signs and bytes of any code page) or a number, also a hexadecimal one.
class VrmlLexer {
  public:
    explicit VrmlLexer(std::string_view text) : text_(text) {}

    VrmlToken next();
    // Continues at `token`, which must come from this lexer.
    void rewind(const VrmlToken& token);

  private:
    void skip_blanks_and_comments();
    void advance_line(char c);
    VrmlToken string_token(VrmlToken token);

    std::string_view text_;
    std::size_t at_ = 0, line_start_ = 0;
    int line_ = 1;
};

}  // namespace tribo::readers
