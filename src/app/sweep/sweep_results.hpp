// SPDX-License-Identifier: MIT
// Writes the results of a sweep: results.csv, results.sqlite and report.html, one row a case, as a stream.
#pragma once

#include <string>

#include "app/sweep/finished_cases.hpp"
#include "app/sweep/sweep_cases.hpp"

namespace tribo::app {

struct SweepCounts {
    std::uint64_t planned = 0, finished = 0, failed = 0;  // failed ones are among the finished
};

// Writes the rows of all finished cases in the order of their numbers, and replaces each file as a whole.
FileResult<SweepCounts> write_results(SweepCases& cases, const FinishedCases& finished,
                                      const std::string& folder);

}  // namespace tribo::app
