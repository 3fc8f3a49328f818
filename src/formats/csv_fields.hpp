// SPDX-License-Identifier: MIT
// The fields of one line of comma-separated text: no quotes, blanks around a field do not count.
#pragma once

#include <string_view>
#include <vector>

namespace tribo::formats {

struct CsvField {
    std::string_view text;  // without blanks around it
    int column = 1;         // of its first character, from 1
};

// Replaces the content of `fields`, so that one vector serves all lines.
void split_csv_line(std::string_view line, std::vector<CsvField>& fields);

// Whether the field is the column `name`; ASCII letters of either case.
bool is_csv_column(std::string_view text, std::string_view name);

}  // namespace tribo::formats
