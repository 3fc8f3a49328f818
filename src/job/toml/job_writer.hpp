// SPDX-License-Identifier: MIT
// Writes the job that stands for a program (LoadedJob::is_program), as a job file.
#pragma once

#include <functional>
#include <string>

#include "job/loader.hpp"

namespace tribo::job {

// Returns the text of a job file that gives the same run when it is loaded: stock, cutters, material, process
// and path. `path_of` turns the name of a file into the one in the job, relative to its folder, of
// UTF-8 without control characters. The assumptions stand at the top as comments.
std::string job_text(const LoadedJob& loaded, const std::function<std::string(const std::string&)>& path_of);

}  // namespace tribo::job
