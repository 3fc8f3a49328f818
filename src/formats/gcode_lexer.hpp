// SPDX-License-Identifier: MIT
// G-code bytes to blocks of words (RS274/NGC, Kramer, Proctor, Messina 2000, section 3.3): letters in either
// case, blanks anywhere, comments in parentheses or after a semicolon. What the words mean is not known here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "formats/text_lines.hpp"

namespace tribo::formats::gcode {

struct Word {
    char letter = 0;  // upper case
    double value = 0;
    int column = 0;  // of the letter, from 1
};

enum class BlockKind {
    words,           // maybe none
    percent,         // a line with %
    program_number,  // O1234 and nothing else
};

struct Block {
    BlockKind kind = BlockKind::words;
    int line = 0;             // from 1
    int column = 0;           // of what makes it a percent or program_number block
    bool deletable = false;   // starts with '/'
    std::vector<Word> words;  // in order, line numbers (N) left out
    std::vector<std::string_view> comments;
};

// Blocks of one text, in order. The block that next() fills is reused, so that a file of short lines costs no
// allocation per line.
class Lexer {
  public:
    // Blocks that start with '/' come without their words where `skip_deletable` says so, whatever stands in
    // them.
    Lexer(std::string_view bytes, std::string source_name, bool skip_deletable);

    // False at the end of the text. Errors carry line and column.
    Result<bool> next(Block& block);
    std::string_view rest() const { return lines_.rest(); }

  private:
    Result<void> read_word(Block& block);
    Result<void> read_comment(Block& block);
    Result<void> read_o_word(Block& block);
    Result<double> read_number(char letter);
    void skip_blanks();
    std::unexpected<Error> refuse(std::size_t at, std::string cause, std::string remedy) const;

    TextLines lines_;
    std::string source_name_;
    bool skip_deletable_;
    std::string_view line_;
    std::size_t at_ = 0;
};

}  // namespace tribo::formats::gcode
