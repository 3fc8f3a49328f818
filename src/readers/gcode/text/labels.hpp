// SPDX-License-Identifier: MIT
// The O-words of a text: start and end of subroutines, loops and branches.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "readers/gcode/cursor.hpp"
#include "readers/gcode/text/parameters.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::gcode {

// Largest number of a program, a line or a loop.
inline constexpr double kLargestLabel = 999'999'999;

enum class Keyword {
    none,  // a program number: O1000
    sub,
    endsub,
    return_,
    call,
    do_,
    while_,
    endwhile,
    if_,
    elseif,
    else_,
    endif,
    repeat,
    endrepeat,
    break_,
    continue_,
};

struct OWord {
    std::string label;  // digits without leading zeros, or <name>
    Keyword keyword = Keyword::none;
    bool is_computed = false;  // the label is an expression
};

// Reads label and keyword. The cursor starts on the O and ends after the keyword. Without parameters a
// computed label is refused.
Result<OWord> read_o_word(Cursor& cursor, const Parameters* parameters);

std::string_view spelling(Keyword keyword);

// A line with an O-word. Indices of other landmarks are -1 if the text has no matching one.
struct Landmark {
    std::string label;
    Keyword keyword = Keyword::none;
    int line = 0;
    TextLines at, after;   // positions before this line and before the next one
    int opener = -1;       // of a closing, branching or leaving keyword: its opening keyword
    int closer = -1;       // of an opening keyword: endsub, endif, endwhile, the while of a do, endrepeat
    int next_branch = -1;  // of if and elseif: the elseif, else or endif that follows
    int last_branch = -1;  // of if: the last branch found so far
};

class Labels {
  public:
    // Reads the whole text once. Refuses more than a million O-words, and more than 1000 levels of nesting.
    static Result<Labels> of(std::string_view bytes, const std::string& source_name, bool skip_deletable);

    const Landmark& operator[](int index) const { return marks_[static_cast<std::size_t>(index)]; }
    // Returns the landmark on that line; -1 if there is none.
    int on_line(int line) const;
    // Returns the first subroutine or program of that label; -1 if there is none.
    int find_sub(std::string_view label) const;
    int find_program(std::string_view label) const;
    // Returns the program that the operator starts: the first one of the text, but where that ends with M99,
    // as subprograms do, the first one behind it that ends with M2 or M30. -1 without a program number.
    int main_program() const;

  private:
    void add(Landmark mark);
    int innermost(std::string_view label, std::initializer_list<Keyword> keywords) const;
    void close(int index, int opener);

    std::vector<Landmark> marks_;  // by line, ascending
    std::vector<int> open_;        // openers without a closer so far
    std::map<std::string, int, std::less<>> subs_, programs_;
};

}  // namespace tribo::readers::gcode
