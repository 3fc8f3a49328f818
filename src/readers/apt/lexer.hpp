// SPDX-License-Identifier: MIT
// APT CLDATA text to statements (ISO 4343, ANSI X3.37): a word, a slash, items between commas. '$$' starts a
// comment, '$' continues the statement on the next line, also past lines of comment. Two kinds of comment are
// statements all the same: those of Creo after '$$->', and the matrix of CATIA below '$$*CATIA0'. The lexer
// does not know the meaning of words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::apt {

// A piece of text without blanks around it, with its place.
struct Item {
    std::string_view text;
    int line = 0, column = 0;
};

struct Statement {
    Item word;                // GOTO; never empty
    std::vector<Item> items;  // after the slash; an item may be empty
    bool is_text = false;     // PARTNO, PPRINT, REMARK, INSERT, ...: free text follows and is not split
    bool is_header = false;   // written in a comment
};

// The statements of one text, in order. Blank lines and comments are left out. next() reuses its statement.
class Lexer {
  public:
    Lexer(std::string_view bytes, std::string source_name);

    // Returns false at the end of the text.
    Result<bool> next(Statement& statement);
    std::string_view rest() const { return lines_.rest(); }

  private:
    bool begin_line();
    void cut_comment(std::size_t from);
    Result<void> read_statement(Statement& statement, std::size_t from);
    void read_catia_matrix(Statement& statement);
    Result<void> read_items(Statement& statement);
    std::unexpected<Error> refuse(std::size_t at, std::string cause, std::string remedy) const;

    TextLines lines_;
    std::string source_name_;
    std::string_view line_;  // without comment and continuation mark
    std::size_t at_ = 0;
    bool continues_ = false;
};

// Compares ASCII letters without regard to case.
bool matches(std::string_view text, std::string_view word);

}  // namespace tribo::readers::apt
