// SPDX-License-Identifier: MIT
// The stock that a job begins with: a solid, or what an earlier job leaves, through any number of jobs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "job/job.hpp"
#include "job/solid.hpp"
#include "job/stock_record.hpp"
#include "motion/path/program.hpp"
#include "session/cut/earlier_cuts.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// What `[stock] from` names.
struct StockSource {
    std::string job;                         // its file, as JobFiles::job takes it
    std::optional<job::StockRecord> record;  // where a render's folder was named
};

// Where a job's files are: on a disk, or among those dropped into a page. Errors carry file and place, but
// for those of `source`, which may leave both to the caller.
struct JobFiles {
    std::function<Result<job::Job>(const std::string& file)> job;
    std::function<Result<motion::Program>(const job::Job&)> program;
    std::function<Result<job::Solid>(const job::JobSolid&)> solid;
    std::function<Result<StockSource>(const std::string& path)> source;
    std::function<std::string(const std::string& file)> identity;  // equal where two names are surely one job
};

// In the coordinates of the job that begins with it.
struct JobStock {
    std::unique_ptr<const field::Shape> blank;
    double blank_volume_mm3 = 0;
    std::vector<EarlierCuts> earlier;  // of the first job first
    std::uint64_t hash = 0;            // of all that decides it
};

// More earlier jobs in a row are taken for a mistake.
inline constexpr std::size_t kLongestChain = 100;

// Reads the job's blank, or the earlier jobs with all that decides the stock they leave: their designed
// surfaces, fixtures, materials and sounds are not looked at. Refused, at the place of `from` where it is
// about that: jobs that begin with each other's stock, chains above kLongestChain, and a folder whose record
// does not fit what its job would do now. The warnings gain those of the earlier programs. `job` went through
// complete_job().
Result<JobStock> read_stock(const job::Job& job, const JobFiles& files, Warnings& warnings);

// What a render of this setup, which began with a stock of that hash, leaves a later job to check. Version
// and job file are the caller's.
job::StockRecord stock_record(const MillSetup& setup, std::uint64_t stock_hash);

}  // namespace tribo::session
