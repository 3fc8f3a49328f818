// SPDX-License-Identifier: MIT
// Head responses from SOFA files (AES69), by libmysofa. Its reader has crashed on bad files in the past.
// Therefore this process reads only one file with it: the set shipped with libmysofa, identified by its hash.
// Any other file is read in a child process with limited memory and time, and the output of the child is
// checked like a file.
#pragma once

#include <string>
#include <string_view>

#include "files/files.hpp"
#include "sound/place/head.hpp"

namespace tribo::files {

// Returns the set shipped with libmysofa (MIT KEMAR, normal pinna: 710 directions, 512 samples at 44.1 kHz).
// An error if the file is missing or different.
FileResult<sound::HrirSet> builtin_hrirs();

// Reads any SOFA file in a child process, started as `program verb FILE`; it must call serve_hrirs(). Takes
// at most kMostSofaSeconds.
FileResult<sound::HrirSet> read_hrirs(const std::string& path, const std::string& program,
                                      const std::string& verb);
inline constexpr double kMostSofaSeconds = 20;

// The work of the child: reads `path` and writes the set to standard output. First it limits itself: memory
// to kMostSofaBytes, processor time to kMostSofaSeconds, no writing of files. Returns the exit code.
int serve_hrirs(const std::string& path);
inline constexpr std::uint64_t kMostSofaBytes = std::uint64_t{1} << 30;

// Encodes and decodes the output of the child. The decoder trusts nothing.
std::string packed_hrirs(const sound::HrirSet& set);
Result<sound::HrirSet> unpacked_hrirs(std::string_view bytes);

}  // namespace tribo::files
