// SPDX-License-Identifier: MIT
// For each tool of a program that chatters, a spindle speed at which it does not.
#pragma once

#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "session/chatter/row_stability.hpp"

namespace tribo::session {

struct StableSpeed {
    std::size_t cutter = 0;
    int line = 0;                                   // of the row that chatters most
    double old_rpm = 0, new_rpm = 0;                // of that row; equal: it stays
    double most_rpm = 0;                            // none above this was asked
    double old_multiplier = 0, new_multiplier = 0;  // the larger one of the two rows
    // Of chatter in the row that chatters most; absent where nothing has a spread.
    std::optional<double> old_probability{}, new_probability{};

    // On all speeds of the tool, and on its feeds: the chip stays.
    double factor() const { return new_rpm / old_rpm; }
    // Stable at the new speed, also 1 % beside it; with a spread in nine of ten cases (dynamics::kRarely).
    bool is_stable() const;
    // Worth a change: stable but for a spread, in which chatter is less probable than before.
    bool is_better() const {
        return new_rpm != old_rpm && new_multiplier <= 1 &&
               (!new_probability || *new_probability < *old_probability);
    }
};

// Collects the rows of a run. One thread.
class StableSpeedSearch {
  public:
    // The setup, with modes of each cutter, must outlive this object.
    explicit StableSpeedSearch(const MillSetup& setup) : setup_(setup), tools_(setup.cutters.size()) {}

    // `multiplier`: as ProgramChatter gives it.
    void add(const milling::CutRow& row, double multiplier);

    // For each tool that cuts: its speed stays if it is stable there; else the one of the chart's speeds
    // (default_speeds()) with the least multiplier, 1 % slower and faster included, of the row that chatters
    // most and of the one that removes most. `most_rpm`: one per cutter, infinite: no bound. A tool that runs
    // faster already gets no faster speed.
    std::vector<StableSpeed> find(const std::vector<double>& most_rpm, const ParallelFor& parallel) const;

  private:
    struct Tool {
        WorstRow worst;
        std::optional<milling::CutRow> heaviest;
    };

    const MillSetup& setup_;
    std::vector<Tool> tools_;
};

}  // namespace tribo::session
