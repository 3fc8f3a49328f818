// SPDX-License-Identifier: MIT
// Programs of NUM 1020, 1040 and 1060 controls in the words of a Fanuc control, line by line. What has no
// such word becomes a word that the reader of G-code refuses by name: GNUM45 for G45.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tribo::readers {

// True if a block, in upper case and without blanks and comments, has words that only this control knows:
// G79 N, G77 H, a cycle with ER.
bool is_block_of_num(std::string_view block);

struct NumWord {
    std::string address;  // one letter, or two: EB
    std::string value;    // a number or a variable of Fanuc
    bool is_negative = false;
};

class NumWords {
  public:
    // The line in the words of Fanuc.
    std::string line(std::string_view text);
    // True if the last line was the '%' of a program.
    bool begins_program() const { return begins_program_; }
    // Ends the program whose lines stand last: here it ends with the next '%', on a Fanuc control with M2 or
    // M99.
    void end_program(std::vector<std::string>& lines) const;

  private:
    std::string variable_at(std::string_view text, std::size_t& at);
    std::string operand_at(std::string_view text, std::size_t& at);
    std::string formula(std::string_view text);
    bool read_word(std::size_t& at, std::vector<NumWord>& words);
    std::string assignment();
    std::string jump(std::size_t at);

    std::string in_;                    // the line, in upper case, without comments and messages
    std::map<std::string, int> names_;  // variables of Fanuc of the names in brackets
    int programs_ = 0;
    bool begins_program_ = false;
};

// A whole program; has as many lines as it.
std::string num_in_fanuc_words(std::string_view bytes);

}  // namespace tribo::readers
