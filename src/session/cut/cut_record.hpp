// SPDX-License-Identifier: MIT
// Record of the rows of a cut. Its forces can be computed again for another feed, spindle speed, material or
// helix without milling again: the engagement of the teeth does not depend on them. (The feed only scales
// the chip.)
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "contact/force_table.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// Collects rows: call add() from MillSinks::row.
class CutRecord {
  public:
    void add(const milling::CutRow& row) { rows_.push_back(row); }
    std::span<const milling::CutRow> rows() const { return rows_; }

  private:
    std::vector<milling::CutRow> rows_;
};

// Changes that need no new milling.
struct CutChange {
    double feed_factor = 1, speed_factor = 1;  // > 0: overrides of feed and spindle speed
    std::optional<milling::CuttingCoefficients> coefficients{};
    // Band of the forces with these coefficients; factors, as in MillSetup.
    double force_low_factor = 1, force_high_factor = 1;
    std::optional<double> helix_deg{};
    // Cases of what has a spread, from which a live cut takes the band of each row; 0: the band is that of
    // the coefficients. Changes no force.
    std::size_t uncertain_cases = 0;

    // Whether no force is changed.
    bool none() const {
        return feed_factor == 1 && speed_factor == 1 && !coefficients.has_value() && !helix_deg.has_value();
    }
    // Factor on the spindle angle per program time.
    double angle_factor() const { return speed_factor / feed_factor; }
    double chip_factor() const { return feed_factor / speed_factor; }  // factor on the feed per tooth
};

// The cutters with the changed helix.
std::vector<milling::Cutter> changed_cutters(const MillSetup& setup, const CutChange& change);
// The band of the forces, from the spread of the coefficients; factors.
struct ForceBand {
    double low = 1, high = 1;
};
ForceBand force_band(const MillSetup& setup, const CutChange& change);

// A row at the changed feed per tooth and spindle speed. Its times stay those of the program.
milling::CutRow changed_row(milling::CutRow row, const CutChange& change);

// Spindle angle at the start of a row with this change, without whole turns.
double changed_phase_rad(const milling::CutRow& row, const CutChange& change);

// Force spectra of rows with this change, on all threads. Times are those at the changed feed. A feed
// override F divides all times by F, also those of rapids and dwells: the record does not contain them.
std::vector<contact::ForceStretch> force_stretches(std::span<const milling::CutRow> rows,
                                                   const MillSetup& setup, const CutChange& change = {},
                                                   const ParallelFor& parallel = serial_for);
inline std::vector<contact::ForceStretch> force_stretches(const CutRecord& record, const MillSetup& setup,
                                                          const CutChange& change = {},
                                                          const ParallelFor& parallel = serial_for) {
    return force_stretches(record.rows(), setup, change, parallel);
}

// Forces of rows with this change. Only rows from `spectra_from` on get a spectrum.
std::vector<milling::RowForce> changed_forces(std::span<const milling::CutRow> rows, const MillSetup& setup,
                                              const CutChange& change, std::size_t spectra_from,
                                              const ParallelFor& parallel = serial_for);

// Hash of everything on which the force along the path depends.
std::uint64_t bake_key(const MillSetup& setup, const contact::ForceTableOptions& options);

}  // namespace tribo::session
