// SPDX-License-Identifier: MIT
#include "readers/text/number_table.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/text/limit_text.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {

std::string header_of(std::span<const NumberColumn> columns) {
    std::string header;
    for (const NumberColumn& column : columns) header.append(header.empty() ? "" : ",").append(column.name);
    return header;
}

NumberTable::NumberTable(std::string_view bytes, std::string source_name,
                         std::span<const NumberColumn> columns, std::string kind)
    : lines_(bytes, std::move(source_name)), columns_(columns), kind_(std::move(kind)) {}

Result<void> NumberTable::read_header() {
    const std::string remedy = "start with the line " + header_of(columns_);
    if (!lines_.next(fields_)) return lines_.refuse(0, "the file holds no " + kind_, remedy);
    if (fields_.size() == 1 && fields_[0].text.find(';') != std::string_view::npos)
        return lines_.refuse(1, "the columns are separated by semicolons", "separate them by commas");
    if (fields_.size() == 1 && fields_[0].text.find_first_of(" \t") != std::string_view::npos)
        return lines_.refuse(1, "the columns are separated by blanks or tabs", "separate them by commas");
    place_.clear();
    for (const NumberColumn& column : columns_) {
        const auto is_it = [&](const CsvField& f) { return is_csv_column(f.text, column.name); };
        const auto found = std::ranges::find_if(fields_, is_it);
        if (found == fields_.end())
            return lines_.refuse(1, "the header has no column " + std::string(column.name), remedy);
        const auto again = std::find_if(found + 1, fields_.end(), is_it);
        if (again != fields_.end()) {
            return lines_.refuse(again->column,
                                 "the column " + std::string(column.name) + " stands there twice",
                                 "rename one of them");
        }
        place_.push_back(static_cast<std::size_t>(found - fields_.begin()));
    }
    field_count_ = fields_.size();
    return {};
}

Result<bool> NumberTable::next(std::span<double> values) {
    assert(values.size() == columns_.size() && place_.size() == columns_.size());
    if (!lines_.next(fields_)) return false;
    if (fields_.size() != field_count_) {
        return lines_.refuse(fields_.back().column,
                             "the line has " + std::to_string(fields_.size()) + " fields, the header " +
                                 std::to_string(field_count_),
                             "give every line a field per column");
    }
    for (std::size_t n = 0; n < columns_.size(); ++n) {
        const CsvField& field = fields_[place_[n]];
        const auto value = number_of(field.text);
        if (!value) {
            return lines_.refuse(field.column,
                                 field.text.empty() ? "a number is missing" : "this is not a number",
                                 "write a decimal number with a point");
        }
        const Limit& limit = columns_[n].limit;
        if (!limit.range.contains(*value))
            return lines_.refuse(field.column, out_of_range(limit, *value), range_remedy(limit));
        values[n] = *value;
    }
    return true;
}

std::unexpected<Error> NumberTable::refuse_at(std::size_t column, std::string cause,
                                              std::string remedy) const {
    return lines_.refuse(fields_[place_[column]].column, std::move(cause), std::move(remedy));
}

std::unexpected<Error> NumberTable::refuse_line(std::string cause, std::string remedy) const {
    return lines_.refuse(0, std::move(cause), std::move(remedy));
}

}  // namespace tribo::readers
