// SPDX-License-Identifier: MIT
// Machines from TOML files, or by their names.
#pragma once

#include <string>

#include "formats/job.hpp"
#include "io/files.hpp"

namespace tribo::io {

// The machine of a name (motion::named_machine), or the one that a .toml file describes with the keys of a
// job's [machine].
FileResult<formats::JobMachine> read_machine_named(const std::string& name_or_file);

}  // namespace tribo::io
