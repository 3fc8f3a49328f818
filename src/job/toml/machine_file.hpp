// SPDX-License-Identifier: MIT
// Machines from TOML files, or by their names.
#pragma once

#include <string>

#include "job/file_source.hpp"
#include "job/job.hpp"

namespace tribo::job {

// The machine of a name (motion::named_machine), or the one that a .toml file describes with the keys of a
// job's [machine].
FileResult<JobMachine> read_machine_named(const FileSource& files, const std::string& name_or_file);

}  // namespace tribo::job
