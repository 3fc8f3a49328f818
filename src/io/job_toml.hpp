// SPDX-License-Identifier: MIT
// Reads a job file (TOML; docs/job.md) and checks all that can be checked without opening the files
// that it names.
#pragma once

#include <string>
#include <string_view>

#include "formats/job.hpp"
#include "io/files.hpp"

namespace tribo::io {

// `file` is the job's own name: errors carry it, and paths in the job count from its folder. A machine file
// that the job names is read too.
FileResult<formats::Job> parse_job(std::string_view text, const std::string& file);

FileResult<formats::Job> read_job(const std::string& path);

}  // namespace tribo::io
