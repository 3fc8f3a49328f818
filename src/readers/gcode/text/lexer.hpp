// SPDX-License-Identifier: MIT
// G-code bytes to blocks of words (RS274/NGC, Kramer, Proctor, Messina 2000, section 3.3): letters in either
// case, blanks anywhere, comments in parentheses or after a semicolon, numbers as expressions. What the words
// mean is not known here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "readers/gcode/cursor.hpp"
#include "readers/gcode/text/expression.hpp"
#include "readers/gcode/text/parameters.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::gcode {

struct Word {
    char letter = 0;  // upper case
    double value = 0;
    int column = 0;  // of the letter, from 1
};

// #1=2 or #<name>=2, which takes effect after the whole block is read.
struct Assignment {
    ParameterName to;
    double value = 0;
    int column = 0;  // of the '#', from 1
};

enum class BlockKind {
    words,    // maybe none
    percent,  // a line with %
    o_word,   // a program number, or the flow of control; words do not stand beside it
};

struct Block {
    BlockKind kind = BlockKind::words;
    int line = 0;             // from 1
    int column = 0;           // of what makes it a percent or o_word block
    bool deletable = false;   // starts with '/'
    std::vector<Word> words;  // in order, line numbers (N) left out
    std::vector<Assignment> assignments;
    std::vector<std::string_view> comments;
};

// Blocks of one text. The block that next() fills is reused, so that a file of short lines costs no
// allocation per line.
class Lexer {
  public:
    // Blocks that start with '/' come without their words where `skip_deletable` says so, whatever stands in
    // them. Expressions are evaluated with `parameters`, which must outlive the lexer.
    Lexer(std::string_view bytes, std::string source_name, bool skip_deletable, const Parameters& parameters);

    // False at the end of the text. Errors carry line and column.
    Result<bool> next(Block& block);

    // What next() reads next: a place that go_to() leads back to.
    const TextLines& place() const { return lines_; }
    void go_to(const TextLines& place) { lines_ = place; }

    // The line of the block; it stands on the O of an o_word block.
    Cursor& cursor() { return cursor_; }
    // Reads the comments that end an o_word block; refuses anything else.
    Result<void> read_end(Block& block);

  private:
    Result<void> read_word(Block& block);
    Result<void> read_comment(Block& block);
    Result<void> read_assignment(Block& block);
    Result<double> read_number(char letter, std::size_t word);
    std::unexpected<Error> refuse_number(char letter, std::size_t word, bool has_sign);

    TextLines lines_;
    std::string source_name_;
    bool skip_deletable_;
    const Parameters& parameters_;
    Cursor cursor_;
};

// Leads the cursor past what may stand before the words of a block: '/' and N123. True where the block is
// deletable.
bool skip_block_head(Cursor& cursor);

}  // namespace tribo::readers::gcode
