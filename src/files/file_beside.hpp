// SPDX-License-Identifier: MIT
// A file that grows beside the one it will replace: whoever is stopped half way leaves the old file as it
// was.
#pragma once

#include <string>

#include "files/files.hpp"

namespace tribo::files {

struct FileBeside {
    int descriptor = -1;
    bool beside = false;  // false: a device, a pipe or a link, written as it is
};

// Where the new file grows; what a killed run left there is overwritten.
std::string name_beside(const std::string& path);
FileResult<FileBeside> open_beside(const std::string& path);
// The whole file takes its name, closed before; 0 or the system's error number.
int take_name(const std::string& path);

}  // namespace tribo::files
