// SPDX-License-Identifier: MIT
// The trace of a servo: position of the probe and force on the hand, a row per tick. A trace can also be read
// as a stroke (stroke_csv.hpp).
#pragma once

#include <string>
#include <string_view>

#include "base/vec3.hpp"

namespace tribo::readers {

struct FeelTraceRow {
    double t_s = 0;
    Vec3 position_mm;  // of the probe, stock frame
    Vec3 force_n;      // on the hand, stock frame
    bool contact = false;
};

inline constexpr std::string_view feel_trace_header = "t_s,x_mm,y_mm,z_mm,fx_n,fy_n,fz_n,contact\n";

// Appends the row and a line end: 6 decimals each, contact as 0 or 1.
void append_feel_trace_row(std::string& csv, const FeelTraceRow& row);

}  // namespace tribo::readers
