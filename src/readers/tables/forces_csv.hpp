// SPDX-License-Identifier: MIT
// forces.csv: a table of the cut, a row per piece of the path.
#pragma once

#include <optional>
#include <string>

#include "milling/engagement/cut_row.hpp"
#include "milling/force/force_peaks.hpp"

namespace tribo::readers {

// The columns of a job with modes.
struct ChatterColumns {
    std::optional<double> multiplier, peak_displacement_mm;  // absent: an empty cell
};

// The largest force in a turn as it may be in truth.
struct ForceBandColumns {
    double low_n = 0, high_n = 0;
};

// The names of the columns and a line end; those of ChatterColumns and ForceBandColumns are the last ones.
std::string forces_csv_header(bool chatter, bool band = false);

// Appends the row and a line end. Decimals: volume, duration and displacement 9; torque 8; time, positions,
// axis and multiplier 6; force 5; reconciled 4; angles 3; speeds 2. Null: without these columns.
void append_force_row(std::string& csv, const milling::CutRow& row, const milling::ForcePeaks& force,
                      const ChatterColumns* chatter = nullptr, const ForceBandColumns* band = nullptr);

}  // namespace tribo::readers
