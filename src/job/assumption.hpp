// SPDX-License-Identifier: MIT
// Makes a job for a program without a job file: dropped into the page, or given in place of a job.
#pragma once

#include "job/job.hpp"
#include "job/program_inputs.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {

// A job with the inputs, and with default feed, spindle speed and material where they are absent, for reading
// the program. Its machine has only its name.
Job job_of_program(const std::string& file, PathKind kind, const ProgramInputs& inputs);

// Each assumption is one warning that says what to write instead.
//
// Adds the tools that the program declares, and a flat end mill of 6 mm for all that nothing describes.
// Refuses what take_declared_tools() refuses.
Result<void> assume_tools(Job& job, const motion::Program& program, Warnings& warnings);
// Adds the block whose size is given, at the path; else the stock that the program declares; else a block
// around the path, with its top at zero if the path goes below zero. Call it after assume_tools(). Refuses a
// program without feed moves that would need a block, and blocks out of range.
Result<void> assume_stock(Job& job, const motion::Program& program, const ProgramInputs& inputs,
                          Warnings& warnings);
// Says which of feed, speed and material are assumed.
void say_assumed_process(const Job& job, const motion::Program& program, const ProgramInputs& inputs,
                         Warnings& warnings);

}  // namespace tribo::job
