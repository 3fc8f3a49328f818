// SPDX-License-Identifier: MIT
#include "readers/tables/forces_csv.hpp"

#include <cmath>

#include "base/math.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

// Fine enough for a cutter of 0.1 mm.
constexpr int kTimeDecimals = 6, kLengthDecimals = 6, kAxisDecimals = 6, kVolumeDecimals = 9;
constexpr int kSpeedDecimals = 2, kAngleDecimals = 3, kForceDecimals = 5, kTorqueDecimals = 8;
constexpr int kDurationDecimals = 9, kFactorDecimals = 4;
constexpr int kMultiplierDecimals = 6, kDisplacementDecimals = 9;

void append_field(std::string& csv, double value, int decimals) {
    csv += ',';
    append_fixed(csv, value, decimals);
}
void append_field(std::string& csv, Vec3 value, int decimals) {
    append_field(csv, value.x, decimals);
    append_field(csv, value.y, decimals);
    append_field(csv, value.z, decimals);
}

// A small value gets more decimals, so that it keeps four digits down to a millionth of these.
void append_fine(std::string& csv, double value, int decimals) {
    constexpr int kDigits = 4, kMore = 6;
    double small = 1;
    for (int n = kDigits; n < decimals; ++n) small /= 10;
    append_field(csv, value, value != 0 && std::abs(value) < small ? decimals + kMore : decimals);
}
void append_fine(std::string& csv, Vec3 value, int decimals) {
    append_fine(csv, value.x, decimals);
    append_fine(csv, value.y, decimals);
    append_fine(csv, value.z, decimals);
}

}  // namespace

std::string forces_csv_header(bool chatter, bool band) {
    std::string header =
        "t_s,line,tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k,spindle_rpm,feed_mm_per_min,entry_deg,exit_"
        "deg,axial_depth_mm,mean_fx_n,mean_fy_n,mean_fz_n,peak_fx_n,peak_fy_n,peak_fz_n,peak_fxy_n,"
        "mean_torque_nm,peak_torque_nm,removed_mm3,duration_s,reconciled";
    if (chatter) header += ",multiplier,peak_displacement_mm";
    if (band) header += ",peak_force_low_n,peak_force_high_n";
    return header + '\n';
}

void append_force_row(std::string& csv, const milling::CutRow& row, const milling::ForcePeaks& force,
                      const ChatterColumns* chatter, const ForceBandColumns* band) {
    constexpr double kDegPerRad = 180 / math::kPi;
    const milling::EngagementHull hull = milling::hull(row.engagement);
    append_fixed(csv, row.start_s, kTimeDecimals);
    csv += ',';
    csv += std::to_string(row.line);
    append_field(csv, row.pose.tip_mm, kLengthDecimals);
    append_field(csv, row.pose.frame.z, kAxisDecimals);
    append_field(csv, row.spindle_rpm, kSpeedDecimals);
    append_field(csv, row.feed_mm_per_s() * 60, kSpeedDecimals);
    append_field(csv, hull.entry_rad * kDegPerRad, kAngleDecimals);
    append_field(csv, hull.exit_rad * kDegPerRad, kAngleDecimals);
    append_field(csv, hull.axial_depth_mm, kLengthDecimals);
    append_fine(csv, force.mean_n, kForceDecimals);
    append_fine(csv, force.peak_n, kForceDecimals);
    append_fine(csv, force.peak_xy_n, kForceDecimals);
    append_fine(csv, 1e-3 * force.mean_torque_nmm, kTorqueDecimals);
    append_fine(csv, 1e-3 * force.peak_torque_nmm, kTorqueDecimals);
    append_field(csv, row.removed_mm3, kVolumeDecimals);
    append_field(csv, row.duration_s(), kDurationDecimals);
    append_field(csv, row.reconciled, kFactorDecimals);
    if (chatter != nullptr) {
        csv += ',';
        if (chatter->multiplier) append_fixed(csv, *chatter->multiplier, kMultiplierDecimals);
        csv += ',';
        if (chatter->peak_displacement_mm)
            append_fixed(csv, *chatter->peak_displacement_mm, kDisplacementDecimals);
    }
    if (band != nullptr) {
        append_fine(csv, band->low_n, kForceDecimals);
        append_fine(csv, band->high_n, kForceDecimals);
    }
    csv += '\n';
}

}  // namespace tribo::readers
