// SPDX-License-Identifier: MIT
// The stock that a job begins with: a solid, or what earlier jobs leave of one.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "job/loader.hpp"
#include "job/stock_record.hpp"
#include "session/cut/earlier_cuts.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// In the coordinates of the job that begins with it.
struct JobStock {
    std::unique_ptr<const field::Shape> blank;
    double blank_volume_mm3 = 0;
    std::vector<EarlierCuts> earlier;  // of the first job first
    std::uint64_t hash = 0;            // of all that decides it
};

// Refused: an earlier job that prepare_moves() refuses, and, at the place of `from`, the folder of a render
// whose record does not fit what its job would do now. `warnings` gains what was assumed for earlier jobs.
Result<JobStock> stock_of(const job::LoadedJob& loaded, Warnings& warnings);

// What a render of this setup leaves a later job to check. Version and job file are the caller's.
job::StockRecord stock_record(const MillSetup& setup);

}  // namespace tribo::session
