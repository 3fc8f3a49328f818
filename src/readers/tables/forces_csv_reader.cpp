// SPDX-License-Identifier: MIT
#include "readers/tables/forces_csv_reader.hpp"

#include <array>

#include "base/limits.hpp"
#include "readers/text/csv_fields.hpp"
#include "readers/text/number_table.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

// The table is the result of a run. Its numbers are only held against what no run writes.
constexpr Limit kTime{"time", "s", {0, 1e9}, "", "No program lasts 30 years."};
constexpr Limit kValue{"value", "", {-1e12, 1e12}, "", "No machine has such a force, speed or volume."};
constexpr Limit kLine{"line", "", {0, 2e9}, "", "No program has more lines."};

constexpr std::array<NumberColumn, 15> kColumns{{
    {"t_s", kTime},
    {"duration_s", kTime},
    {"line", kLine},
    {"tip_x_mm", kLimits.coordinate},
    {"tip_y_mm", kLimits.coordinate},
    {"tip_z_mm", kLimits.coordinate},
    {"spindle_rpm", kValue},
    {"feed_mm_per_min", kValue},
    {"axial_depth_mm", kValue},
    {"mean_fx_n", kValue},
    {"mean_fy_n", kValue},
    {"mean_fz_n", kValue},
    {"peak_fxy_n", kValue},
    {"peak_torque_nm", kValue},
    {"removed_mm3", kValue},
}};

// The multipliers of a table. The cells may be empty, which a NumberTable refuses.
class MultiplierColumn {
  public:
    explicit MultiplierColumn(std::string_view bytes) : lines_(bytes, "") {
        if (!lines_.next(fields_)) return;
        for (std::size_t n = 0; n < fields_.size(); ++n)
            if (is_csv_column(fields_[n].text, "multiplier")) place_ = n;
    }
    // Of the next line.
    std::optional<double> next() {
        if (!place_ || !lines_.next(fields_) || *place_ >= fields_.size()) return {};
        return number_of(fields_[*place_].text);
    }

  private:
    CsvLines lines_;
    std::vector<CsvField> fields_;
    std::optional<std::size_t> place_;
};

}  // namespace

Result<std::vector<ForceTableRow>> read_forces_csv(std::string_view bytes, const std::string& source_name) {
    NumberTable table(bytes, source_name, kColumns, "table of forces");
    if (auto header = table.read_header(); !header) return std::unexpected(header.error());
    MultiplierColumn multipliers(bytes);
    std::vector<ForceTableRow> rows;
    std::array<double, kColumns.size()> v{};
    while (true) {
        const auto more = table.next(v);
        if (!more) return std::unexpected(more.error());
        if (!*more) return rows;
        if (!rows.empty() && v[0] < rows.back().start_s)
            return table.refuse_at(0, "the time is before that of the row above", "render the job again");
        rows.push_back({v[0],
                        v[1],
                        static_cast<int>(v[2]),
                        {v[3], v[4], v[5]},
                        v[6],
                        v[7],
                        v[8],
                        length(Vec3{v[9], v[10], v[11]}),
                        v[12],
                        v[13],
                        v[14],
                        multipliers.next()});
    }
}

}  // namespace tribo::readers
