// SPDX-License-Identifier: MIT
// A new file beside the file that it will replace. If the program is stopped half way, the old file stays
// unchanged.
#pragma once

#include <string>

#include "files/files.hpp"

namespace tribo::files {

struct FileBeside {
    int descriptor = -1;
    bool beside = false;  // false: a device, a pipe or a link, which is written directly
};

// Returns the name of the new file. A file left there by a killed run is overwritten.
std::string name_beside(const std::string& path);
FileResult<FileBeside> open_beside(const std::string& path);
// Renames the complete, closed file to `path`. Returns 0 or the error number of the system.
int take_name(const std::string& path);

}  // namespace tribo::files
