// SPDX-License-Identifier: MIT
// A job file run in this process, so that tests see what files do not hold: engagement, spectrum, frames.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "job/job.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::test {

// What a row of a session refers to, kept.
struct KeptRow {
    milling::ForceRow values;
    milling::Engagement engagement;
    contact::ForceSpectrum spectrum;
    milling::ToolTravel feed;
    std::size_t cutter = 0;
    double chip_mm3_per_s = 0;
};

struct JobRun {
    std::string error;  // of reading or setting up; everything else is then empty
    job::Job job;
    milling::CuttingCoefficients coefficients;
    std::vector<KeptRow> rows;
    session::MillTotals totals;
    Warnings warnings;
};

// Reads `job.toml` among the files (name, text) as the program does, and mills it; stock and fixtures must be
// boxes.
JobRun run_job(const std::map<std::string, std::string>& files, double cell_mm = 0.25);

}  // namespace tribo::test
