// SPDX-License-Identifier: MIT
// What a job leaves out and its program or tool table says: stock and tools. The order of precedence is the
// job file, then the tool table, then the program itself (BLK FORM, CUTTER/, tool comments).
#pragma once

#include "job/job.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {

// Gives the job a stock where it has none and a cutter for each tool of the program that it does not
// describe, each with a warning that says where it was taken from and what was assumed. Refuses a job that
// then still has no stock or no cutter.
Result<void> complete_job(Job& job, const motion::Program& program, Warnings& warnings);

}  // namespace tribo::job
