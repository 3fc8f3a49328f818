// SPDX-License-Identifier: MIT
// A job for a program that comes alone: dropped into the page, or named in place of a job.
#pragma once

#include "job/job.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {

// What a program must be read with when nobody says more: a feed and a spindle speed where it has none.
Job job_of_program(const std::string& file, PathKind kind);

// Gives the job what complete_job() would miss: a block around the path, with its top at zero where the path
// goes below it, and a cutter of 6 mm for each tool that nobody describes. Says each assumption.
void assume_job(Job& job, const motion::Program& program, Warnings& warnings);

}  // namespace tribo::job
