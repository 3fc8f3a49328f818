// SPDX-License-Identifier: MIT
#include "readers/tables/forces_csv.hpp"

#include "base/math.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

// Fine enough for a cutter of 0.1 mm.
constexpr int kTimeDecimals = 6, kLengthDecimals = 6, kAxisDecimals = 6, kVolumeDecimals = 9;
constexpr int kSpeedDecimals = 2, kAngleDecimals = 3, kForceDecimals = 5, kTorqueDecimals = 8;
constexpr int kDurationDecimals = 9, kFactorDecimals = 4;

void append(std::string& csv, double value, int decimals) {
    csv += ',';
    append_fixed(csv, value, decimals);
}
void append(std::string& csv, Vec3 value, int decimals) {
    append(csv, value.x, decimals);
    append(csv, value.y, decimals);
    append(csv, value.z, decimals);
}

}  // namespace

void append_force_row(std::string& csv, const milling::CutRow& row, const milling::ForcePeaks& force) {
    constexpr double kDegPerRad = 180 / math::kPi;
    const milling::EngagementHull hull = milling::hull(row.engagement);
    append_fixed(csv, row.start_s, kTimeDecimals);
    csv += ',';
    csv += std::to_string(row.line);
    append(csv, row.pose.tip_mm, kLengthDecimals);
    append(csv, row.pose.frame.z, kAxisDecimals);
    append(csv, row.spindle_rpm, kSpeedDecimals);
    append(csv, row.feed_mm_per_s() * 60, kSpeedDecimals);
    append(csv, hull.entry_rad * kDegPerRad, kAngleDecimals);
    append(csv, hull.exit_rad * kDegPerRad, kAngleDecimals);
    append(csv, hull.axial_depth_mm, kLengthDecimals);
    append(csv, force.mean_n, kForceDecimals);
    append(csv, force.peak_n, kForceDecimals);
    append(csv, force.peak_xy_n, kForceDecimals);
    append(csv, 1e-3 * force.mean_torque_nmm, kTorqueDecimals);
    append(csv, 1e-3 * force.peak_torque_nmm, kTorqueDecimals);
    append(csv, row.removed_mm3, kVolumeDecimals);
    append(csv, row.duration_s(), kDurationDecimals);
    append(csv, row.reconciled, kFactorDecimals);
    csv += '\n';
}

}  // namespace tribo::readers
