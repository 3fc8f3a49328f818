// SPDX-License-Identifier: MIT
// The one loader of jobs: a job with all the files that it names, read and checked, from wherever they are.
// The program, the page's module and the tests use it; session::prepare_mill() makes a run of it.
#pragma once

#include <string>
#include <vector>

#include "job/file_source.hpp"
#include "job/job.hpp"
#include "job/solid.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {

// A job that leaves the stock with which another begins.
struct EarlierJob {
    Job job;
    motion::Program program;
    StockSource source;  // what the other job names
};

struct LoadedJob {
    Job job;  // after complete_job()
    motion::Program program;
    Solid blank;                      // of the first job, in that job's coordinates
    std::vector<EarlierJob> earlier;  // the nearest first; each begins with the stock that the next leaves
    std::vector<Solid> fixtures;
    std::optional<readers::Model> part;  // the designed surface
    Warnings warnings;
};

struct LoadOptions {
    std::string part;  // a model as the designed surface in place of the job's; empty: as the job says
};

// More earlier jobs in a row are taken for a mistake.
inline constexpr std::size_t kLongestChain = 100;

// Reads the job, its program, its blank or the earlier jobs, fixtures and designed surface. Of earlier jobs
// it reads what decides the stock: their designed surfaces, fixtures and sounds are not looked at. Refused,
// at the place of `from`: jobs that begin with each other's stock, and more than kLongestChain of them.
FileResult<LoadedJob> load_job(const FileSource& files, const std::string& name,
                               const LoadOptions& options = {});

// The same for a program that comes without a job; what it does not say is assumed, with a warning each.
FileResult<LoadedJob> load_program(const FileSource& files, const std::string& name,
                                   const LoadOptions& options = {});

// A job's program alone. The job gains what complete_job() finds in it, and the program's warnings what that
// says.
FileResult<motion::Program> read_and_complete(const FileSource& files, Job& job);

}  // namespace tribo::job
