// SPDX-License-Identifier: MIT
// The text of an NCI file: pairs of lines, a number that says what the record is and a line of values. The
// records come out as statements of APT (readers/apt/lexer.hpp): the number is the word, the values are the
// items.
#pragma once

#include <string>
#include <string_view>

#include "readers/apt/lexer.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::nci {

class Records {
  public:
    Records(std::string_view bytes, std::string source_name);

    // Returns false at the end of the text. Blank lines before the number of a record are passed over; its
    // line of values may be blank.
    Result<bool> next(apt::Statement& record);
    // The number of the last record.
    int code() const { return code_; }

  private:
    TextLines lines_;
    std::string source_name_;
    int code_ = 0;
};

}  // namespace tribo::readers::nci
