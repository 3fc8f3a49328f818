// SPDX-License-Identifier: MIT
// Comma-separated tables of numbers whose header names the columns.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/limits.hpp"
#include "readers/text/csv_fields.hpp"

namespace tribo::readers {

struct NumberColumn {
    std::string_view name;
    Limit limit;
};

// The names with commas between them.
std::string header_of(std::span<const NumberColumn> columns);

// Reads these columns in any order, and leaves others alone. Lines of any end, comments and empty lines as in
// CsvLines; numbers within their limits. Linear in the bytes.
class NumberTable {
  public:
    // `kind` is what the file should hold, for messages: "stroke". Keeps a reference to the columns.
    NumberTable(std::string_view bytes, std::string source_name, std::span<const NumberColumn> columns,
                std::string kind);

    Result<void> read_header();
    // Writes the numbers of the next line, in the order of the columns. False after the last line.
    Result<bool> next(std::span<double> values);

    int line() const { return lines_.number(); }
    // Returns an error at the column (its index) of the last line, or for the whole line.
    std::unexpected<Error> refuse_at(std::size_t column, std::string cause, std::string remedy) const;
    std::unexpected<Error> refuse_line(std::string cause, std::string remedy) const;

  private:
    CsvLines lines_;
    std::span<const NumberColumn> columns_;
    std::string kind_;
    std::vector<CsvField> fields_;
    std::vector<std::size_t> place_;  // index of each column among the fields
    std::size_t field_count_ = 0;
};

}  // namespace tribo::readers
