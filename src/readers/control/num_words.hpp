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
    struct Word {
        std::string address;  // one letter, or two: EB
        std::string value;    // a number, a variable, or a bracket
        bool is_negative = false;
    };

    std::string variable_at(std::size_t& at) const;
    std::string operand_at(std::size_t& at) const;
    std::string formula(std::string_view text) const;
    bool read_word(std::size_t& at, std::vector<Word>& words) const;
    std::string assignment();
    std::string jump(std::size_t at) const;
    std::string in_words(std::vector<Word> words) const;

    std::string in_;  // the line, in upper case, without comments and messages
    mutable std::map<std::string, int> names_;
    int programs_ = 0;
    bool begins_program_ = false;
};

}  // namespace tribo::readers
