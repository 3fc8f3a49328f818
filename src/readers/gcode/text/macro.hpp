// SPDX-License-Identifier: MIT
// Statements of Fanuc macro programs: IF GOTO, IF THEN, WHILE DO, END, GOTO, and output to printers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "readers/gcode/cursor.hpp"
#include "readers/gcode/text/parameters.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::gcode {

enum class MacroKind {
    none,
    then,   // IF [] THEN: the rest of the block is run if `holds`
    jump,   // GOTO, IF [] GOTO: to the line N of that number, if `holds`
    loop,   // WHILE [] DO, DO: runs while `holds`
    end,    // END
    print,  // DPRNT[], BPRNT[], POPEN, PCLOS: nothing moves
};

struct MacroStatement {
    MacroKind kind = MacroKind::none;
    bool holds = true;  // its condition
    int number = 0;     // of the line, or of DO and END
};

// True if IF, WHILE or GOTO stands here.
bool begins_macro_statement(Cursor cursor);

// Reads the statement at the cursor; MacroKind::none if none begins here. The cursor ends behind it.
Result<MacroStatement> read_macro_statement(Cursor& cursor, const Parameters& parameters);

// The places that macro statements go to.
class MacroPlaces {
  public:
    // Reads the whole text once. Refuses more than a million numbered lines.
    static Result<MacroPlaces> of(std::string_view bytes, const std::string& source_name,
                                  bool skip_deletable);

    // Returns the line N of that number in the program around `line`: the first one behind it, else the first
    // one of the program. Null: there is none.
    const TextLines* find_number(int number, int line) const;
    // Returns the line after the END of that number that follows `line` in its program. Null: there is none.
    const TextLines* find_end(int number, int line) const;

  private:
    struct Place {
        int line = 0;
        TextLines where;
    };
    using Places = std::map<int, std::vector<Place>>;  // by number; each by line, ascending

    int program_start(int line) const;
    int program_end(int line) const;

    Places numbers_, ends_;
    std::vector<int> programs_;  // lines with a program number, ascending
};

}  // namespace tribo::readers::gcode
