// SPDX-License-Identifier: MIT
// Makes a job for a program without a job file: dropped into the page, or given in place of a job.
#pragma once

#include "job/job.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {

// A job with default feed and spindle speed, for reading the program.
Job job_of_program(const std::string& file, PathKind kind);

// Adds everything that complete_job() requires: a block around the path, with its top at zero if the path
// goes below zero, and a cutter of 6 mm for each undescribed tool. Each assumption gives a warning.
// Refuses what called_tools() refuses.
Result<void> assume_job(Job& job, const motion::Program& program, Warnings& warnings);

}  // namespace tribo::job
