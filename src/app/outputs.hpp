// SPDX-License-Identifier: MIT
// Refuses to write over what the run reads, or where nothing can be written, before any work is done.
#pragma once

#include <string>
#include <vector>

#include "files/output_folder.hpp"

namespace tribo::app {

// Refuses a name in `outputs` that is a file which was read until now, one of `inputs` or another output.
// Links and other names of the same file count. Refuses a folder, and a file whose folder is not there. Empty
// names are left out. `inputs` are read later.
FileResult<void> check_outputs(const std::vector<std::string>& outputs,
                               const std::vector<std::string>& inputs = {});

// Refuses a folder whose older run wrote a file that was read until now: it would be replaced.
FileResult<void> check_output_folder(const files::OutputFolder& folder);

}  // namespace tribo::app
