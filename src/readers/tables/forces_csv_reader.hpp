// SPDX-License-Identifier: MIT
// Reads forces.csv back, the columns that two runs can be compared by.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"

namespace tribo::readers {

// A piece of the path, as forces.csv has it. Force on the tool, over a turn of the spindle.
struct ForceTableRow {
    double start_s = 0, duration_s = 0;  // >= 0
    int line = 0;                        // of the program; 0: none
    Vec3 tip_mm;                         // stock frame
    double spindle_rpm = 0, feed_mm_per_min = 0, axial_depth_mm = 0;
    double mean_n = 0;          // size of the mean force
    double peak_xy_n = 0;       // largest force across the axis
    double peak_torque_nm = 0;  // extreme of largest size, signed
    double removed_mm3 = 0;
    std::optional<double> multiplier;  // of a job with modes, where it is known
};

// Refuses a table without these columns (`multiplier` may be missing, and its cells may be empty) and times
// that fall. Other columns are ignored. Linear in the bytes. An empty table is one without a cut.
Result<std::vector<ForceTableRow>> read_forces_csv(std::string_view bytes, const std::string& source_name);

}  // namespace tribo::readers
