// SPDX-License-Identifier: MIT
#include "readers/text/csv_fields.hpp"

#include <algorithm>
#include <utility>

namespace tribo::readers {
namespace {

// Replaces the content of `fields`, so that one vector serves all lines.
void split(std::string_view line, std::vector<CsvField>& fields) {
    fields.clear();
    std::size_t start = 0;
    for (;;) {
        const std::size_t comma =
            fields.size() + 1 < kMostFields ? line.find(',', start) : std::string_view::npos;
        const std::string_view raw =
            line.substr(start, comma == std::string_view::npos ? comma : comma - start);
        std::size_t blanks = 0;
        while (blanks < raw.size() && is_blank(raw[blanks])) ++blanks;
        fields.push_back({trimmed(raw), static_cast<int>(start + blanks) + 1});
        if (comma == std::string_view::npos) return;
        start = comma + 1;
    }
}

}  // namespace

bool CsvLines::next(std::vector<CsvField>& fields) {
    while (const auto line = lines_.next()) {
        const std::string_view text = trimmed(*line);
        if (text.empty() || text.front() == '#') continue;
        split(*line, fields);
        return true;
    }
    return false;
}

std::unexpected<Error> CsvLines::refuse(int column, std::string cause, std::string remedy) const {
    return fail_at(source_name_, std::max(1, lines_.number()), column, std::move(cause), std::move(remedy));
}

bool is_csv_column(std::string_view text, std::string_view name) {
    return std::ranges::equal(text, name, {}, to_upper, to_upper);
}

}  // namespace tribo::readers
