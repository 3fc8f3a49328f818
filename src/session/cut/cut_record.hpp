// SPDX-License-Identifier: MIT
// A cut as it was measured, kept so that its force can be worked out again for another feed, spindle speed,
// material or helix without milling again: what the teeth meet does not depend on them (but for the feed's
// share in the chip).
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

// What may change while it runs.
struct CutChange {
    double feed_factor = 1, speed_factor = 1;  // > 0: overrides of feed and spindle
    std::optional<milling::CuttingCoefficients> coefficients{};
    std::optional<double> helix_deg{};

    // Whether the forces are those of the program as it was written.
    bool none() const {
        return feed_factor == 1 && speed_factor == 1 && !coefficients.has_value() && !helix_deg.has_value();
    }
    // The times of a program go by faster by the feed, its spindle angle by the speed.
    double angle_factor() const { return speed_factor / feed_factor; }
    double chip_factor() const { return feed_factor / speed_factor; }  // of the feed per tooth
};

// The spindle's angle where a row begins with something changed; whole turns are left out.
double changed_phase_rad(const milling::CutRow& row, const CutChange& change);

// The spectra of rows with something changed, on all threads; times are those of the program at the
// changed feed. A feed override F shortens all times by F (rapids and dwells too, as the record does not know
// them).
std::vector<contact::ForceStretch> force_stretches(std::span<const milling::CutRow> rows,
                                                   const MillSetup& setup, const CutChange& change = {},
                                                   const ParallelFor& parallel = serial_for);
inline std::vector<contact::ForceStretch> force_stretches(const CutRecord& record, const MillSetup& setup,
                                                          const CutChange& change = {},
                                                          const ParallelFor& parallel = serial_for) {
    return force_stretches(record.rows(), setup, change, parallel);
}

// The forces of rows with something changed; spectra of those from `spectra_from` on only.
std::vector<milling::RowForce> changed_forces(std::span<const milling::CutRow> rows, const MillSetup& setup,
                                              const CutChange& change, std::size_t spectra_from,
                                              const ParallelFor& parallel = serial_for);

// Tells records of different jobs apart: everything that the force along the path depends on.
std::uint64_t bake_key(const MillSetup& setup, const contact::ForceTableOptions& options);

}  // namespace tribo::session
