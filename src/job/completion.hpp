// SPDX-License-Identifier: MIT
// Completes stock and tools of a job from its program and tool table. The order of precedence is the
// job file, then the tool table, then the program itself (BLK FORM, CUTTER/, tool comments).
#pragma once

#include "job/job.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {

// Adds a missing stock, and a cutter for each tool of the program that the job does not describe. Each gives
// a warning with its source and the assumptions. Refuses a job that
// still has no stock or no cutter.
Result<void> complete_job(Job& job, const motion::Program& program, Warnings& warnings);

}  // namespace tribo::job
