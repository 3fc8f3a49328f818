// SPDX-License-Identifier: MIT
// The steady cut of a program: the row in which it chatters most.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "job/loader.hpp"
#include "session/chatter/steady_cut.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// A place in a program. Nothing: all of it.
struct CutPlace {
    std::optional<int> line;
    std::optional<double> t_s;
};

// Mills the setup of a loaded job and takes engagement, tool, speed and feed direction of the row with the
// largest multiplier among those at the place; of rows within 1 % of it the one that lasts longest. The bands
// are those that the field measures, alike neighbours joined to at most kMostBands (row_stability.hpp). Edges
// of a flat bottom are left out. Refuses a job without modes and a place at which nothing is cut. The setup
// must not have a prescribed engagement. `progress` as in MillSinks; when it stops the run, the result means
// nothing.
Result<SteadyCut> critical_row(const job::LoadedJob& loaded, MillSetup setup, const CutPlace& place,
                               const ParallelFor& parallel,
                               const std::function<bool(double fraction)>& progress);

}  // namespace tribo::session
