// SPDX-License-Identifier: MIT
// A job file run in this process, so that tests see what files do not hold: engagement, spectrum, frames.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "job/job.hpp"
#include "session/kept_rows.hpp"

namespace tribo::test {

struct JobRun {
    std::string error;  // of reading or setting up; everything else is then empty
    job::Job job;
    milling::CuttingCoefficients coefficients;
    std::vector<session::KeptRow> rows;
    session::MillTotals totals;
    Warnings warnings;
};

// Loads `job.toml` from the files (name, text) and mills it.
JobRun run_job(const std::map<std::string, std::string>& files, double cell_mm = 0.25);

}  // namespace tribo::test
