// SPDX-License-Identifier: MIT
// What a sweep computes of one job.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "job/loader.hpp"
#include "job/sweep/sweep.hpp"

namespace tribo::app {

// Adds the results of the job by name, on this thread. Those of the summary have the names of summary.json;
// of lists they are the length. Refuses a job that cannot run, or not within `memory_bytes` (0: half of the
// machine's memory). An interrupted run is an error, too.
Result<void> run_case(const job::Sweep& sweep, job::LoadedJob loaded, double memory_bytes,
                      std::vector<std::pair<std::string, double>>& results);

}  // namespace tribo::app
