// SPDX-License-Identifier: MIT
// The stock at the start of a job: a solid, or the result of earlier jobs.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "job/loader.hpp"
#include "job/stock_record.hpp"
#include "session/cut/earlier_cuts.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// In the coordinates of this job.
struct JobStock {
    std::unique_ptr<const field::Shape> blank;
    double blank_volume_mm3 = 0;
    std::vector<EarlierCuts> earlier;  // oldest job first
    std::uint64_t hash = 0;            // of blank, earlier cuts and frames
};

// Refuses an earlier job that prepare_moves() refuses. Also refuses a render folder whose record differs from
// its job file as it is now; the error is at the place of `from`. Assumptions about earlier jobs are added
// to `warnings`. `memory_bytes`: as in MillOptions, for each earlier job.
Result<JobStock> stock_of(const job::LoadedJob& loaded, Warnings& warnings, std::uint64_t memory_bytes = 0);

// The record that a later job checks. The caller sets version and job file.
job::StockRecord stock_record(const MillSetup& setup);

}  // namespace tribo::session
