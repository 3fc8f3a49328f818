// SPDX-License-Identifier: MIT
// Comma-separated text, line by line. There are no quotes; blanks around a field are ignored.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {

// Fields of a line. The last one takes the rest of a longer line, which no table of Tribo has.
inline constexpr std::size_t kMostFields = 1000;

struct CsvField {
    std::string_view text;  // without blanks around it
    int column = 1;         // of its first character, from 1
};

// The lines of a table, without empty lines and comments that begin with #.
class CsvLines {
  public:
    // `source_name` is the name of the table in errors.
    CsvLines(std::string_view text, std::string source_name)
        : lines_(text), source_name_(std::move(source_name)) {}

    // Writes the fields of the next line into `fields`. Returns false after the last line.
    bool next(std::vector<CsvField>& fields);
    int number() const { return lines_.number(); }
    // Returns an error at a column of the last line of next(); column 0: for the whole line.
    std::unexpected<Error> refuse(int column, std::string cause, std::string remedy) const;

  private:
    TextLines lines_;
    std::string source_name_;
};

// True when the field is the column `name`; the case of ASCII letters is ignored.
bool is_csv_column(std::string_view text, std::string_view name);

}  // namespace tribo::readers
