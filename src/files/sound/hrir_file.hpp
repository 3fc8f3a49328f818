// SPDX-License-Identifier: MIT
// Head responses out of SOFA files (AES69), by libmysofa. Its reader has a history of crashes on bad files,
// so in this process it reads one file only: the set that it ships, known by its hash. Any other file is read
// in a child process that can use no more than a share of memory and time, and what the child says is checked
// like the file would be.
#pragma once

#include <string>
#include <string_view>

#include "files/files.hpp"
#include "sound/place/head.hpp"

namespace tribo::files {

// The set that libmysofa ships (MIT KEMAR, normal pinna: 710 directions, 512 samples at 44.1 kHz). An error
// where it is missing or is another file.
FileResult<sound::HrirSet> builtin_hrirs();

// Any SOFA file, through the child `program FILE`-wise: `program` is started as `program verb FILE` and
// has to do what serve_hrirs() does. Takes at most kMostSofaSeconds.
FileResult<sound::HrirSet> read_hrirs(const std::string& path, const std::string& program,
                                      const std::string& verb);
inline constexpr double kMostSofaSeconds = 20;

// The child's work: reads `path` and writes the set to standard output. First it gives up what it does not
// need: memory beyond kMostSofaBytes, processor time beyond kMostSofaSeconds, writing files. Gives the code
// to exit with.
int serve_hrirs(const std::string& path);
inline constexpr std::uint64_t kMostSofaBytes = std::uint64_t{1} << 30;

// What the child writes, and its reverse, which trusts nothing.
std::string packed_hrirs(const sound::HrirSet& set);
Result<sound::HrirSet> unpacked_hrirs(std::string_view bytes);

}  // namespace tribo::files
