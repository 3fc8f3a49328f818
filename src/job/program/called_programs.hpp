// SPDX-License-Identifier: MIT
// The programs that a program calls and that lie in files of their own beside it.
#pragma once

#include <string>

#include "job/file_source.hpp"
#include "job/program_file.hpp"

namespace tribo::job {

// Returns the program with those that it calls and that its folder has behind it, each where its control
// looks for it: O1000 to M99, o<name> sub, %_N_NAME_SPF, BEGIN PGM to END PGM. Their lines count on behind
// its own. `warnings` says which file each comes from. Programs without a file are left to the reader.
std::string with_called_programs(const FileSource& files, std::string program, const std::string& path,
                                 const ProgramFileOptions& options, Warnings& warnings);

}  // namespace tribo::job
