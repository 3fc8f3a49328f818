// SPDX-License-Identifier: MIT
// The largest feed at which a row of a cut stays within limits. The engagement of the teeth does not depend
// on the feed, so the row is not milled again: its force is computed for other chips.
#pragma once

#include <vector>

#include "milling/force/force.hpp"
#include "milling/force/row_force.hpp"
#include "session/audit/row_loads.hpp"

namespace tribo::session {

// One thread; keeps its memory from row to row.
class FeedSolver {
  public:
    // Only force, torque, power, stress and deflection of the model's limits count. `sure`: the upper end of
    // the band of each load stays within the lower end of its limit's.
    FeedSolver(const MillSetup& setup, const LoadModel& model, bool sure);

    // The load that is nearest to its limit, over it, at `factor` times the row's feed; > 0.
    double ratio(const milling::CutRow& row, double factor);
    // The same from the force of the row itself.
    double ratio(const milling::CutRow& row, const milling::ForcePeaks& peaks) const;
    // The largest factor, at most `most`, at which the ratio is not above 1. 0: no feed is small enough,
    // because the edges alone need more. `now`: the ratio of the row itself. The mean force is linear in the
    // feed, and its peak is convex, a maximum of norms; so is every ratio. Only where run-out lets another
    // tooth begin to cut does the force of its edge make it jump.
    double largest_factor(const milling::CutRow& row, double now, double most);

  private:
    const LoadModel& model_;
    std::vector<milling::ForceModel> forces_;            // one per cutter
    std::vector<std::array<double, kLoadKinds>> scale_;  // one per cutter: factors on ratios
};

}  // namespace tribo::session
