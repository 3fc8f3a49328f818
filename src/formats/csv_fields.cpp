// SPDX-License-Identifier: MIT
#include "formats/csv_fields.hpp"

#include <algorithm>

#include "formats/text_lines.hpp"

namespace tribo::formats {

void split_csv_line(std::string_view line, std::vector<CsvField>& fields) {
    fields.clear();
    std::size_t start = 0;
    for (;;) {
        const std::size_t comma = line.find(',', start);
        const std::string_view raw =
            line.substr(start, comma == std::string_view::npos ? comma : comma - start);
        std::size_t blanks = 0;
        while (blanks < raw.size() && is_blank(raw[blanks])) ++blanks;
        fields.push_back({trimmed(raw), static_cast<int>(start + blanks) + 1});
        if (comma == std::string_view::npos) return;
        start = comma + 1;
    }
}

bool is_csv_column(std::string_view text, std::string_view name) {
    return std::ranges::equal(text, name, {}, to_upper, to_upper);
}

}  // namespace tribo::formats
