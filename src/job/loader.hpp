// SPDX-License-Identifier: MIT
// The loader of jobs: reads and checks a job with all its files, from any FileSource. Used by the program, by
// the module of the page and by the tests. session::prepare_mill() makes a run from the result. A program may
// stand in place of a job; what it does not say is assumed.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "job/file_source.hpp"
#include "job/job.hpp"
#include "job/program_inputs.hpp"
#include "job/solid.hpp"
#include "job/sweep/job_change.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {

// An earlier job, whose result is the stock of another job.
struct EarlierJob {
    Job job;
    motion::Program program;
    StockSource source;  // as named by the other job
};

struct LoadedJob {
    Job job;  // after complete_job()
    motion::Program program;
    Solid blank;                      // of the first job, in its coordinates
    std::vector<EarlierJob> earlier;  // latest first; the stock of each is the result of the next entry
    std::vector<Solid> fixtures;
    std::uint64_t solid_bytes = 0;       // memory of blank and fixtures that are meshes, about
    std::optional<readers::Model> part;  // the designed surface
    bool is_program = false;             // a program stood in place of the job
    Warnings assumptions;                // about such a program; also the first of `warnings`
    Warnings warnings;
};

struct LoadOptions {
    std::string part{};  // model of the designed surface in place of that of the job; empty: from the job
    // Memory for moves and models, with all that is made of them before milling, bytes. More is refused
    // before it is allocated. 0: only the limits of the readers.
    std::uint64_t memory_bytes = 0;
    std::function<double()> clock_s{};  // ends endless loops of programs; see readers::GcodeOptions
    ProgramInputs program{};            // for a program in place of a job; a job does not use them
    std::vector<JobChange> changes{};   // of the job, not of its earlier jobs; a program takes none
};

// Largest number of earlier jobs in a chain; more are probably a mistake.
inline constexpr std::size_t kLongestChain = 100;

// Largest number of triangles of all fixtures of a job; a model that several fixtures name is read once.
inline constexpr std::uint64_t kMostFixtureTriangles = readers::kMaxTriangles;

// Reads the job, its program, its frequency responses, its blank or earlier jobs, fixtures and designed
// surface. Of earlier jobs only the files that decide the stock are read, no designed surfaces, fixtures,
// responses and sounds. Refuses cycles of
// jobs and chains longer than kLongestChain, with the place of `from`.
//
// If `name` is a program (by its name or content), reads it with the inputs of the options. What they leave
// out is taken from the program or assumed, with warnings. The job is then complete: written to a file
// (toml/job_writer.hpp) and loaded again it gives the same run. Refuses a file that is neither.
FileResult<LoadedJob> load_job(const FileSource& files, const std::string& name,
                               const LoadOptions& options = {});

// Reads only the program of a job and its frequency responses, and completes the job with complete_job() and
// add_fitted_modes(). Their warnings are added to those of the program.
FileResult<motion::Program> read_and_complete(const FileSource& files, Job& job,
                                              const LoadOptions& options = {});

}  // namespace tribo::job
