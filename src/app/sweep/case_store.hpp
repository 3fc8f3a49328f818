// SPDX-License-Identifier: MIT
// The finished cases of a sweep on the disk: files of lines, one JSON object a line, that are only ever
// appended to. A line that a killed writer left half is no case.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/files.hpp"

namespace tribo::app {

// SHA-256 of all that a case depends on, 32 hexadecimal digits of it.
using CaseId = std::string;

struct CaseResult {
    CaseId id;
    std::vector<std::pair<std::string, double>> values;  // results by name
    std::string error;                                   // why there are none; empty: there are
    bool died = false;                                   // its process ended: a later run tries again
};

// One line, with its end.
std::string line_of(const CaseResult& result);
// No value: the line is no whole case.
std::optional<CaseResult> read_case(std::string_view line);

// Calls `use` with each whole case of each file in `dir` that ends in ".cases", by the names of the files,
// with its file and the offset of its line. Refuses only what cannot be read.
struct CasePlace {
    std::uint32_t file = 0;  // an index of `files`
    std::uint64_t offset = 0;
};
FileResult<void> scan_cases(const std::string& dir, std::vector<std::string>& files,
                            const std::function<void(const CaseResult&, CasePlace)>& use);

// The name of a file of this process for results of a sweep with this digest. No two processes that live have
// one file, here or on another machine.
std::string own_case_file(const std::string& digest, const std::string& what);

// The identities of the whole cases in one file; none where there is no file.
FileResult<std::vector<CaseId>> ids_in(const std::string& path);

// Appends whole lines to one file. A half line at its end is cut off first. One writer at a time.
class CaseFile {
  public:
    static FileResult<CaseFile> open(const std::string& path);
    CaseFile(CaseFile&& other) noexcept;
    CaseFile& operator=(CaseFile&&) = delete;
    ~CaseFile();

    // The cases that the file already holds.
    const std::vector<CaseId>& ids() const { return ids_; }
    FileResult<void> add(const CaseResult& result);
    // Sends all lines to the disk.
    FileResult<void> sync();

  private:
    CaseFile() = default;

    std::string path_;
    int descriptor_ = -1;
    std::vector<CaseId> ids_;
};

}  // namespace tribo::app
