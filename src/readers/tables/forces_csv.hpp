// SPDX-License-Identifier: MIT
// forces.csv: a table of the cut, a row per piece of the path.
#pragma once

#include <string>
#include <string_view>

#include "milling/engagement/cut_row.hpp"
#include "milling/force/force_peaks.hpp"

namespace tribo::readers {

inline constexpr std::string_view forces_csv_header =
    "t_s,line,tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k,spindle_rpm,feed_mm_per_min,entry_deg,exit_deg,"
    "axial_depth_mm,mean_fx_n,mean_fy_n,mean_fz_n,peak_fx_n,peak_fy_n,peak_fz_n,peak_fxy_n,mean_torque_nm,"
    "peak_torque_nm,removed_mm3,duration_s,reconciled\n";

// Appends the row and a line end. Decimals: volume and duration 9; torque 8; time, positions and axis 6;
// force 5; reconciled 4; angles 3; speeds 2.
void append_force_row(std::string& csv, const milling::CutRow& row, const milling::ForcePeaks& force);

}  // namespace tribo::readers
