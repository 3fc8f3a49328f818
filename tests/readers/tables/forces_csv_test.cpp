// SPDX-License-Identifier: MIT
#include "readers/tables/forces_csv.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "base/math.hpp"

namespace tribo::readers {
namespace {

TEST(ForcesCsv, HasTheColumnsThatOthersReadInTheirOrder) {
    const std::string header =
        "t_s,line,tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k,spindle_rpm,feed_mm_per_min,entry_deg,"
        "exit_deg,axial_depth_mm,mean_fx_n,mean_fy_n,mean_fz_n,peak_fx_n,peak_fy_n,peak_fz_n,peak_fxy_n,"
        "mean_torque_nm,peak_torque_nm,removed_mm3,duration_s,reconciled";
    EXPECT_EQ(forces_csv_header(false), header + "\n");
    EXPECT_EQ(forces_csv_header(true), header + ",multiplier,peak_displacement_mm\n");
    EXPECT_EQ(forces_csv_header(false, true), header + ",peak_force_low_n,peak_force_high_n\n");
}

TEST(ForcesCsv, WritesARowWithAFieldPerColumn) {
    milling::CutRow row;
    row.start_s = 0.03;
    row.end_s = 0.155;
    row.length_mm = 1.875;
    row.line = 12;
    row.pose.tip_mm = {1.5, -2, 0.0000004};
    row.pose.frame.z = {0, 0.6, 0.8};
    row.spindle_rpm = 6000;
    constexpr double kRad = math::kPi / 180;
    row.engagement.bands = {{0.5, 1, 100 * kRad, 180.12345 * kRad}, {1, 2.5, 90 * kRad, 120 * kRad}};
    row.removed_mm3 = 6;
    row.reconciled = 1.0125;
    milling::ForcePeaks force;
    force.mean_n = {-50.75, 111.97, 29.67};
    force.peak_n = {-171.1, 218.4, 45.7};
    force.peak_xy_n = 225.6;
    force.mean_torque_nmm = 500;
    force.peak_torque_nmm = 1251;
    std::string csv;
    append_force_row(csv, row, force);
    EXPECT_EQ(
        csv,
        "0.030000,12,1.500000,-2.000000,0.000000,0.000000,0.600000,0.800000,6000.00,900.00,90.000,180.123,"
        "2.000000,-50.75000,111.97000,29.67000,-171.10000,218.40000,45.70000,225.60000,0.50000000,"
        "1.25100000,6.000000000,0.125000000,1.0125\n");
    EXPECT_EQ(std::ranges::count(csv, ','), std::ranges::count(forces_csv_header(false), ','));

    const std::string rigid = csv.substr(0, csv.size() - 1);
    csv.clear();
    const ChatterColumns chatter{1.25, 0.0375};
    append_force_row(csv, row, force, &chatter);
    EXPECT_EQ(csv, rigid + ",1.250000,0.037500000\n");
    csv.clear();
    const ChatterColumns unknown;
    append_force_row(csv, row, force, &unknown);
    EXPECT_EQ(csv, rigid + ",,\n");
    csv.clear();
    const ForceBandColumns band{150.25, 300.5};
    append_force_row(csv, row, force, &chatter, &band);
    EXPECT_EQ(csv, rigid + ",1.250000,0.037500000,150.25000,300.50000\n");
}

// A cutter of 0.1 mm with a chip of 0.1 um: the torque is less than what most cuts need decimals for.
TEST(ForcesCsv, KeepsTheDigitsOfSmallForces) {
    milling::CutRow row;
    milling::ForcePeaks force;
    force.mean_n = {0.012345678, -3.456789e-6, 0};
    force.peak_n = {0.1, 0.099999, -1};
    force.mean_torque_nmm = 3.456789e-5;
    force.peak_torque_nmm = 0.25;
    std::string csv;
    append_force_row(csv, row, force);
    EXPECT_NE(csv.find(",0.01234567800,-0.00000345679,0.00000,0.10000,0.09999900000,-1.00000,0.00000,"
                       "0.00000003456789,0.00025000,"),
              std::string::npos)
        << csv;
}

}  // namespace
}  // namespace tribo::readers
