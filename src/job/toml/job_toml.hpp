// SPDX-License-Identifier: MIT
// Reads a job file (TOML; docs/job.md) and checks all that can be checked without opening the files
// that it names.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "job/file_source.hpp"
#include "job/job.hpp"
#include "job/sweep/job_change.hpp"

namespace tribo::job {

// `file` is the job's own name: errors carry it, and paths in the job count from its folder. A machine file
// that the job names is read too, from `files`. `changes`: keys that get other values first.
FileResult<Job> parse_job(std::string_view text, const std::string& file, const FileSource& files,
                          std::span<const JobChange> changes = {});

FileResult<Job> read_job(const FileSource& files, const std::string& path,
                         std::span<const JobChange> changes = {});

}  // namespace tribo::job
