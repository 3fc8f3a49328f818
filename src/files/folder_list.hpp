// SPDX-License-Identifier: MIT
// The list of the files that a run wrote into a folder: what a later run may remove. All other files there
// belong to the user.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "files/files.hpp"

namespace tribo::files {

inline constexpr const char* kFolderList = ".tribo-files";

// Writes the list of all files in `dir`.
FileResult<void> write_folder_list(const std::string& dir);

// The names of the files of the run, relative to `dir`, with the list itself. Empty: there is no list, and
// no run wrote this folder.
std::set<std::string> read_folder_list(const std::string& dir);

// The entries of `dir` that are not in `listed`, relative to it and in order: files, links, devices, and
// folders without entries. Refuses folders that cannot be read.
FileResult<std::vector<std::string>> files_of_others(const std::string& dir,
                                                     const std::set<std::string>& listed);

// Puts them into `to` as well, as hard links where the file system has them, else as copies. Refuses what is
// already there under such a name.
FileResult<void> keep_files(const std::vector<std::string>& names, const std::string& from,
                            const std::string& to);

}  // namespace tribo::files
