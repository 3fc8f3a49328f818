// SPDX-License-Identifier: MIT
#include "formats/forces_csv.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace tribo::formats {
namespace {

TEST(ForcesCsv, HasTheColumnsThatOthersReadInTheirOrder) {
    EXPECT_EQ(
        forces_csv_header,
        "t_s,line,tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k,spindle_rpm,feed_mm_per_min,entry_deg,"
        "exit_deg,axial_depth_mm,mean_fx_n,mean_fy_n,mean_fz_n,peak_fx_n,peak_fy_n,peak_fz_n,peak_fxy_n,"
        "mean_torque_nm,peak_torque_nm,removed_mm3\n");
}

TEST(ForcesCsv, WritesARowWithAFieldPerColumn) {
    milling::ForceRow row;
    row.t_s = 0.03;
    row.line = 12;
    row.tip_mm = {1.5, -2, 0.0000004};
    row.axis = {0, 0.6, 0.8};
    row.spindle_rpm = 6000;
    row.feed_mm_per_min = 900;
    row.entry_deg = 90;
    row.exit_deg = 180.12345;
    row.axial_depth_mm = 2;
    row.mean_n = {-50.75, 111.97, 29.67};
    row.peak_n = {-171.1, 218.4, 45.7};
    row.peak_fxy_n = 225.6;
    row.mean_torque_nm = 0.5;
    row.peak_torque_nm = 1.251;
    row.removed_mm3 = 6;
    std::string csv;
    append_force_row(csv, row);
    EXPECT_EQ(
        csv,
        "0.030000,12,1.500000,-2.000000,0.000000,0.000000,0.600000,0.800000,6000.00,900.00,90.000,180.123,"
        "2.000000,-50.750,111.970,29.670,-171.100,218.400,45.700,225.600,0.50000,1.25100,6.000000\n");
    EXPECT_EQ(std::ranges::count(csv, ','), std::ranges::count(forces_csv_header, ','));
}

}  // namespace
}  // namespace tribo::formats
