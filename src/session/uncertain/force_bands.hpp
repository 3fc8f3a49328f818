// SPDX-License-Identifier: MIT
// Forces as they may be in truth: the rows of a cut in many equally likely cases of what is known with a
// spread only, the coefficients of the force and the run-out of each cutter.
#pragma once

#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "milling/force/force_peaks.hpp"
#include "session/cut/cut_record.hpp"
#include "session/cut/mill_session.hpp"
#include "sweep/band.hpp"

namespace tribo::session {

// The peaks of a row in each case. The values are lognormal and independent of each other
// (sweep/spread_factors.hpp); the coefficients are off together, and case n has the force of case n of
// cases_of() (session/chatter/probability.hpp).
class ForceCases {
  public:
    // Keeps a copy of the cutters. `count` > 0. With a change, `row` below must have its feed.
    ForceCases(const MillSetup& setup, std::size_t count, ParallelFor parallel, const CutChange& change = {});

    std::size_t count() const { return force_.size(); }
    // `stated`: of the row with the stated values. Valid until the next call. One thread.
    const std::vector<milling::ForcePeaks>& peaks(const milling::CutRow& row,
                                                  const milling::ForcePeaks& stated);
    // The band of the peak force in these cases.
    sweep::Band peak_force_n();

  private:
    std::vector<milling::Cutter> cutters_;
    milling::CuttingCoefficients coefficients_;
    ParallelFor parallel_;
    std::vector<double> force_;                   // factor of each case
    std::vector<std::vector<double>> runout_mm_;  // of each cutter in each case; empty: as stated
    std::vector<milling::ForcePeaks> peaks_;
    std::vector<double> scratch_;
};

// True where the coefficients, the run-out of a cutter or a mode have a spread.
bool has_spread(const MillSetup& setup);

// The bands of a whole run.
class ForceBands {
  public:
    ForceBands(const MillSetup& setup, std::size_t count, ParallelFor parallel);

    // The rows of MillSinks::row, each once. Returns the band of the peak force.
    sweep::Band add(const milling::CutRow& row, const milling::ForcePeaks& stated);

    struct Totals {
        sweep::Band mean_force_n, peak_force_n, peak_torque_nmm, peak_power_w;
    };
    Totals totals() const;

  private:
    ForceCases cases_;
    std::vector<ForceTotals> totals_;  // of each case
};

}  // namespace tribo::session
