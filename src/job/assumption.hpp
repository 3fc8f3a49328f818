// SPDX-License-Identifier: MIT
// Makes a job for a program without a job file: dropped into the page, or given in place of a job.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "job/job.hpp"
#include "job/program_inputs.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {

// A job with the inputs, and with default feed, spindle speed and material where they are absent, for reading
// the program. Its machine has only its name.
Job job_of_program(const std::string& file, PathKind kind, const ProgramInputs& inputs);

// A flat end mill of 6 mm for each tool that nothing describes, or a smaller one: the radius compensation and
// the pockets of a program may have no place for 6 mm.
class AssumedTools {
  public:
    AssumedTools() = default;
    AssumedTools(const std::vector<int>& numbers, const motion::Program& program);

    bool empty() const { return tools_.empty(); }
    // Appends the tools to the job's.
    void add_to(Job& job) const;
    // The program was refused with these tools: makes the one smaller that is in the spindle there. False if
    // it is not assumed, or none is smaller.
    bool shrink_after(const Error& refusal);
    void say(Warnings& warnings) const;

  private:
    struct Tool {
        int number = 0;
        std::size_t size = 0;
        std::string refusal;  // of the size before
    };
    std::string source_;
    std::vector<Tool> tools_;
    std::vector<std::pair<int, int>> begins_;  // the lines from which on a tool mills, and its number
};

// Each assumption is one warning that says what to write instead.
//
// Adds the tools that the program declares, and returns those that nothing describes. Refuses what
// take_declared_tools() refuses.
Result<AssumedTools> take_tools(Job& job, const motion::Program& program, Warnings& warnings);
// Adds the block whose size is given, at the path; else the stock that the program declares; else a block
// around the path, with its top at zero if the path goes below zero. Call it when the job has its tools.
// Refuses a program without feed moves that would need a block, and blocks out of range.
Result<void> assume_stock(Job& job, const motion::Program& program, const ProgramInputs& inputs,
                          Warnings& warnings);
// Says which of feed, speed and material are assumed.
void say_assumed_process(const Job& job, const motion::Program& program, const ProgramInputs& inputs,
                         Warnings& warnings);

}  // namespace tribo::job
