// SPDX-License-Identifier: MIT
// Flags for a program that stands in place of a job, for all verbs that take a job.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "job/loader.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace tribo::app {

// As written by the user.
struct ProgramFlags {
    std::vector<std::string> tools;  // words of a tool, or the name of a tool table
    std::string stock, material, machine, dialect, job_out;
    std::optional<double> spindle_rpm, feed_mm_per_min;
};

// Adds the flags and JOB (or another name of it), where `-` is standard input. The references to job and
// flags must live as long as the verb.
CLI::Option* add_job(CLI::App& verb, std::string& job, const std::string& description, ProgramFlags& flags,
                     const char* name = "JOB");

// Refuses what is not understood, with the flag.
Result<job::ProgramInputs> program_inputs(const ProgramFlags& flags);
// Refuses any of the flags beside something that is no program. `is_what` follows "and": "this is a job".
Result<void> refuse_flags(const ProgramFlags& flags, const std::string& file, const std::string& is_what,
                          const std::string& remedy);
// Writes the job to the file of --job-out, if that is given. Refuses to replace a file that says something
// else or was read, and a name that is one of `outputs`, the other files of the run.
FileResult<void> write_job_out(const ProgramFlags& flags, const job::LoadedJob& loaded,
                               std::vector<std::string> outputs = {});

}  // namespace tribo::app
