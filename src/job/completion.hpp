// SPDX-License-Identifier: MIT
// Completes stock and tools of a job from its program and tool table. The order of precedence is the
// job file, then the tool table, then the program itself (BLK FORM, CUTTER/, tool comments).
#pragma once

#include "job/job.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {

// Takes from the program, or from its tool table, what the job leaves out: a missing stock; a cutter for each
// called tool that the job does not describe. Each gives a warning with its source and the assumptions.
// Refuse what is out of range, and what called_tools() refuses.
Result<void> take_declared_stock(Job& job, const motion::Program& program, Warnings& warnings);
Result<void> take_declared_tools(Job& job, const motion::Program& program, Warnings& warnings);

// Does both. Refuses a job that still has no stock or no cutter.
Result<void> complete_job(Job& job, const motion::Program& program, Warnings& warnings);

}  // namespace tribo::job
