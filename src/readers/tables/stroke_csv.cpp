// SPDX-License-Identifier: MIT
#include "readers/tables/stroke_csv.hpp"

#include <array>

#include "base/text/decimal.hpp"
#include "readers/text/number_table.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kShownColumns = 4;  // both kinds have four columns

using Columns = std::array<NumberColumn, kShownColumns>;
using Values = std::array<double, kShownColumns>;

constexpr NumberColumn kStrokeTime{"t_s", kLimits.stroke_time};
constexpr NumberColumn kX{"x_mm", kLimits.coordinate};
constexpr NumberColumn kY{"y_mm", kLimits.coordinate};
constexpr Columns kProbe{kStrokeTime, kX, kY, {"z_mm", kLimits.coordinate}};
constexpr Columns kFinger{kStrokeTime, kX, kY, {"force_n", kLimits.stroke_force}};

// Hands the values of each line to `add`.
template <class Add>
Result<void> read(std::string_view bytes, const Columns& columns, const StrokeOptions& options, Add add) {
    NumberTable table(bytes, options.source_name, columns, "stroke");
    if (auto header = table.read_header(); !header) return header;
    Values values{};
    double last_t_s = 0;
    for (std::size_t count = 0;; ++count) {
        const auto more = table.next(values);
        if (!more) return std::unexpected(more.error());
        if (!*more) {
            if (count >= 2) return {};
            return table.refuse_line("a stroke needs two points, this file has " + std::to_string(count),
                                     "add the missing lines");
        }
        if (count > 0 && !(values[0] > last_t_s)) {
            return table.refuse_at(0, "the time is not after that of the point before",
                                   "let t_s rise from line to line");
        }
        if (count == options.max_points) {
            return table.refuse_line("more than " + std::to_string(options.max_points) + " points",
                                     "split the stroke");
        }
        add(values);
        last_t_s = values[0];
    }
}

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
    const auto done =
        read(bytes, kProbe, options, [&](const Values& v) { points.push_back({v[0], {v[1], v[2], v[3]}}); });
    if (!done) return std::unexpected(done.error());
    return points;
}

Result<std::vector<FingerPoint>> read_finger_stroke(std::string_view bytes, const StrokeOptions& options) {
    std::vector<FingerPoint> points;
    const auto done =
        read(bytes, kFinger, options, [&](const Values& v) { points.push_back({v[0], v[1], v[2], v[3]}); });
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
