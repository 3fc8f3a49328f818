// SPDX-License-Identifier: MIT
// Totals of a cut.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/math.hpp"
#include "base/vec3.hpp"
#include "milling/engagement/chip.hpp"
#include "milling/engagement/collision.hpp"
#include "milling/engagement/cut_row.hpp"
#include "milling/force/force_peaks.hpp"

namespace tribo::session {

struct MillCollision {
    milling::CollisionKind kind;
    int line = 0;
    double t_s = 0;
    Vec3 tip_mm;
};

// Of the forces of all rows.
struct ForceTotals {
    double cutting_s = 0, impulse_n_s = 0;      // the latter: sum of |mean force| x time
    double mean_force_n = 0, peak_force_n = 0;  // the former: over the time of cutting
    double peak_torque_nmm = 0, peak_power_w = 0;

    void add(const milling::CutRow& row, const milling::ForcePeaks& peaks) {
        const double seconds = row.duration_s();
        cutting_s += seconds;
        impulse_n_s += length(peaks.mean_n) * seconds;
        mean_force_n = cutting_s > 0 ? impulse_n_s / cutting_s : 0;
        peak_force_n = std::max(peak_force_n, peaks.peak_force_n);
        peak_torque_nmm = std::max(peak_torque_nmm, peaks.peak_torque_nmm);
        peak_power_w =
            std::max(peak_power_w, peaks.peak_torque_nmm * 1e-3 * row.spindle_rpm / 60 * math::kTwoPi);
    }
};

struct MillTotals : ForceTotals {
    double duration_s = 0;
    double path_mm = 0;                         // feed moves
    double removed_mm3 = 0, remaining_mm3 = 0;  // by this job; at the end
    bool is_stock_gone = false;                 // nothing is left at the end
    double chip_mm3 = 0;                        // measured, before reconciliation: should equal fed_mm3
    double fed_mm3 = 0;                         // removed by feed moves
    // Where paths begin in the stock (places_in_stock.hpp): what the tool stands in there, and the first
    // line.
    double stood_in_mm3 = 0;
    int stood_in_line = 0;
    // Removed by passes at feed in which no edge cuts, as a tool does that is pulled back with its shank in
    // the stock; and the first line.
    double edgeless_mm3 = 0;
    int edgeless_line = 0;
    // Removed by passes at feed whose rows show much less than they remove, as at a rib that is thinner than
    // a cell; and the line of most of it.
    double unseen_mm3 = 0, most_unseen_mm3 = 0;
    int unseen_line = 0;
    // What cores moved into, where a cutter has no edges (CutRow::core_mm3); and the line of most of it.
    double core_mm3 = 0, most_core_mm3 = 0;
    int core_line = 0;
    // Work of the spindle, and the part from the shear coefficient: ktc times the volume of the chips. The
    // rest comes from the edge coefficients.
    double work_j = 0, shear_work_j = 0;
    double tooth_passing_hz = 0;  // of the cutter with the longest cutting time
    std::size_t rows = 0;
    // Shear work over ktc times the volume that feed moves removed. 1 if force and removed volume agree, for
    // any cut. Absent without a cut or with a prescribed engagement.
    std::optional<double> energy_balance;
    std::vector<MillCollision> collisions;  // at most one per line and kind
    milling::ChipFindings chips;
};

}  // namespace tribo::session
