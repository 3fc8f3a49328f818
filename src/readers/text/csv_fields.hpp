// SPDX-License-Identifier: MIT
// Comma-separated text, line by line: no quotes, blanks around a field do not count.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {

struct CsvField {
    std::string_view text;  // without blanks around it
    int column = 1;         // of its first character, from 1
};

// The lines of a table that hold something: neither empty nor a comment that begins with #.
class CsvLines {
  public:
    // `source_name` is what errors call it.
    CsvLines(std::string_view text, std::string source_name)
        : lines_(text), source_name_(std::move(source_name)) {}

    // The fields of the next line into `fields`; false after the last one.
    bool next(std::vector<CsvField>& fields);
    int number() const { return lines_.number(); }
    // An error at a column of the line that next() gave last; column 0: of the whole line.
    std::unexpected<Error> refuse(int column, std::string cause, std::string remedy) const;

  private:
    TextLines lines_;
    std::string source_name_;
};

// Whether the field is the column `name`; ASCII letters of either case.
bool is_csv_column(std::string_view text, std::string_view name);

}  // namespace tribo::readers
