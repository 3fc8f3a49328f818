// SPDX-License-Identifier: MIT
#include "readers/tables/stroke_csv.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "readers/text/csv_fields.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kShownColumns = 4;  // both kinds have four columns

struct Column {
    std::string_view name;
    Limit limit;
};
using Columns = std::array<Column, kShownColumns>;
using Values = std::array<double, kShownColumns>;

constexpr Column kTime{"t_s", kLimits.stroke_time};
constexpr Column kX{"x_mm", kLimits.coordinate};
constexpr Column kY{"y_mm", kLimits.coordinate};
constexpr Columns kProbe{kTime, kX, kY, {"z_mm", kLimits.coordinate}};
constexpr Columns kFinger{kTime, kX, kY, {"force_n", kLimits.stroke_force}};

std::string header_of(const Columns& columns) {
    std::string header(columns[0].name);
    for (std::size_t n = 1; n < columns.size(); ++n) header.append(",").append(columns[n].name);
    return header;
}

class StrokeReader {
  public:
    StrokeReader(std::string_view bytes, const Columns& columns, const StrokeOptions& options)
        : lines_(bytes, options.source_name), columns_(columns), options_(options) {}

    // Hands the values of each line to `add`.
    template <class Add>
    Result<void> read(Add add) {
        if (auto header = read_header(); !header) return header;
        std::size_t count = 0;
        double last_t_s = 0;
        while (lines_.next(fields_)) {
            const auto values = read_row();
            if (!values) return std::unexpected(values.error());
            const double t_s = (*values)[0];
            if (count > 0 && !(t_s > last_t_s)) {
                return lines_.refuse(fields_[place_[0]].column,
                                     "the time is not after that of the point before",
                                     "let t_s rise from line to line");
            }
            if (count == options_.max_points) {
                return lines_.refuse(1, "more than " + std::to_string(options_.max_points) + " points",
                                     "split the stroke");
            }
            add(*values);
            last_t_s = t_s;
            ++count;
        }
        if (count < 2) {
            return lines_.refuse(0, "a stroke needs two points, this file has " + std::to_string(count),
                                 "add the missing lines");
        }
        return {};
    }

  private:
    Result<void> read_header() {
        const std::string remedy = "start with the line " + header_of(columns_);
        if (!lines_.next(fields_)) return lines_.refuse(0, "the file holds no stroke", remedy);
        if (fields_.size() == 1 && fields_[0].text.find(';') != std::string_view::npos)
            return lines_.refuse(1, "the columns are separated by semicolons", "separate them by commas");
        for (std::size_t n = 0; n < columns_.size(); ++n) {
            const auto is_it = [&](const CsvField& f) { return is_csv_column(f.text, columns_[n].name); };
            const auto found = std::ranges::find_if(fields_, is_it);
            if (found == fields_.end()) {
                return lines_.refuse(1, "the header has no column " + std::string(columns_[n].name), remedy);
            }
            const auto again = std::find_if(found + 1, fields_.end(), is_it);
            if (again != fields_.end()) {
                return lines_.refuse(again->column,
                                     "the column " + std::string(columns_[n].name) + " stands there twice",
                                     "rename one of them");
            }
            place_[n] = static_cast<std::size_t>(found - fields_.begin());
        }
        field_count_ = fields_.size();
        return {};
    }

    Result<Values> read_row() const {
        if (fields_.size() != field_count_) {
            return lines_.refuse(fields_.back().column,
                                 "the line has " + std::to_string(fields_.size()) + " fields, the header " +
                                     std::to_string(field_count_),
                                 "give every line a field per column");
        }
        Values values{};
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
        return values;
    }

    CsvLines lines_;
    const Columns& columns_;
    const StrokeOptions& options_;
    std::vector<CsvField> fields_;
    std::array<std::size_t, kShownColumns> place_{};  // index of each column among the fields
    std::size_t field_count_ = 0;
};

void append_row(std::string& csv, const Values& values) {
    append_decimal(csv, values[0]);
    for (std::size_t n = 1; n < values.size(); ++n) {
        csv += ',';
        append_decimal(csv, values[n]);
    }
    csv += '\n';
}

}  // namespace

Result<std::vector<ProbePoint>> read_probe_stroke(std::string_view bytes, const StrokeOptions& options) {
    std::vector<ProbePoint> points;
    const auto done = StrokeReader(bytes, kProbe, options).read([&](const Values& v) {
        points.push_back({v[0], {v[1], v[2], v[3]}});
    });
    if (!done) return std::unexpected(done.error());
    return points;
}

Result<std::vector<FingerPoint>> read_finger_stroke(std::string_view bytes, const StrokeOptions& options) {
    std::vector<FingerPoint> points;
    const auto done = StrokeReader(bytes, kFinger, options).read([&](const Values& v) {
        points.push_back({v[0], v[1], v[2], v[3]});
    });
    if (!done) return std::unexpected(done.error());
    return points;
}

std::string write_probe_stroke(const std::vector<ProbePoint>& points) {
    std::string csv = header_of(kProbe) + "\n";
    for (const ProbePoint& p : points)
        append_row(csv, {p.t_s, p.position_mm.x, p.position_mm.y, p.position_mm.z});
    return csv;
}

std::string write_finger_stroke(const std::vector<FingerPoint>& points) {
    std::string csv = header_of(kFinger) + "\n";
    for (const FingerPoint& p : points) append_row(csv, {p.t_s, p.x_mm, p.y_mm, p.force_n});
    return csv;
}

}  // namespace tribo::readers
