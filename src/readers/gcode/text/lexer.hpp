// SPDX-License-Identifier: MIT
// G-code bytes to blocks of words (RS274/NGC, Kramer, Proctor, Messina 2000, section 3.3): letters in either
// case, blanks anywhere, comments in parentheses or after a semicolon, numbers as expressions. The lexer does
// not know the meaning of words.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "readers/gcode/cursor.hpp"
#include "readers/gcode/text/expression.hpp"
#include "readers/gcode/text/macro.hpp"
#include "readers/gcode/text/parameters.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::gcode {

struct Word {
    char letter = 0;  // upper case
    double value = 0;
    int column = 0;            // of the letter, from 1
    bool has_point = false;    // a number that is written with a decimal point
    bool is_computed = false;  // by parameters or expressions
};

// #1=2 or #<name>=2. It takes effect after the whole block is read.
struct Assignment {
    ParameterName to;
    double value = 0;
    int column = 0;  // of the '#', from 1
};

enum class BlockKind {
    words,    // may be empty
    percent,  // a line with %
    o_word,   // a program number or control flow; no words beside it
    macro,    // GOTO, DO or END of a Fanuc macro program; no words beside it
};

struct Block {
    BlockKind kind = BlockKind::words;
    int line = 0;            // from 1
    int column = 0;          // of the start of a percent or o_word block
    bool deletable = false;  // starts with '/'
    bool has_nested_comment = false;
    bool has_open_comment = false;                  // not closed on its line
    bool has_deleted_rest = false;                  // behind a '/' inside; it is not read
    bool has_print = false;                         // DPRNT and the like
    std::string_view setting;                       // a line that begins with '$', or with '[' and a name
    std::string_view label;                         // what follows a '%'
    std::string called;                             // NAME of M98<NAME> (Fanuc), in lower case
    MacroStatement macro;                           // of a macro block
    std::optional<Word> corner;                     // ,R or ,C: a corner at the end of the block
    std::optional<Word> polar_radius, polar_angle;  // @ and ^ (LinuxCNC)
    std::vector<Word> words;                        // in order, line numbers (N) left out
    std::vector<Assignment> assignments;
    std::vector<std::string_view> comments;
};

// Returns the G65 or G66 of the block; null if it has none.
const Word* macro_call_in(const Block& block);

// The blocks of one text. next() reuses its block, so that a file of short lines needs no allocation per
// line.
class Lexer {
  public:
    // With `skip_deletable`, blocks that start with '/' come without words, and their content is not checked.
    // Expressions are evaluated with `parameters`, which must outlive the lexer.
    Lexer(std::string_view bytes, std::string source_name, bool skip_deletable, const Parameters& parameters);

    // Returns false at the end of the text. Errors have line and column.
    Result<bool> next(Block& block);

    // The position of the next block, for go_to().
    const TextLines& place() const { return lines_; }
    void go_to(const TextLines& place) {
        lines_ = place;
        rest_at_.reset();
    }
    // The position of the block that next() has read.
    const TextLines& block_place() const { return block_place_; }

    // The line of the block; in an o_word block the cursor is on the O.
    Cursor& cursor() { return cursor_; }
    // Reads the comments at the end of an o_word block. Refuses anything else.
    Result<void> read_end(Block& block);

  private:
    Result<bool> read_macro(Block& block);
    Result<bool> read_head(Block& block);
    Result<bool> read_setting(Block& block);
    Result<void> read_word(Block& block);
    Result<void> read_corner(Block& block);
    Result<void> read_polar(Block& block);
    Result<void> read_comment(Block& block);
    Result<void> read_assignment(Block& block);
    // None: a vacant variable.
    Result<std::optional<double>> read_number(char letter, std::size_t word);
    std::unexpected<Error> refuse_number(char letter, std::size_t word, bool has_sign);

    TextLines lines_, block_place_;
    std::string source_name_;
    bool skip_deletable_;
    const Parameters& parameters_;
    Cursor cursor_;
    std::optional<std::size_t> rest_at_;  // column of a further statement in the line of the block
};

// True for O, and for ':' with a number alone, the program number of ISO tapes.
bool starts_o_word(const Cursor& cursor);

// True if the text has a word of this letter, outside of comments.
bool has_word(std::string_view text, char letter);

// Moves the cursor past '/' and N123 at the start of a block. Returns true if the block is deletable.
bool skip_block_head(Cursor& cursor);

}  // namespace tribo::readers::gcode
