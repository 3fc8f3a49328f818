// SPDX-License-Identifier: MIT
// Whole files in, whole files out. Nothing here throws; every refusal says whether the caller named something
// wrong or the system would not do it, because the two end the program with different codes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/file_result.hpp"

namespace tribo::files {

// What the last failed call of the system means for `file`. `doing` completes "cannot ...: ".
std::unexpected<FileFailure> system_failure(const std::string& file, const char* doing, int error_number);

// Text formats are read whole; above this a file is refused before any memory is taken for it.
inline constexpr std::uint64_t kLargestInputBytes = std::uint64_t{2} << 30;

// The bytes of a regular file or of a pipe.
FileResult<std::string> read_file(const std::string& path, std::uint64_t limit_bytes = kLargestInputBytes);

// Writes a new file piece by piece through one buffer. A failure sticks: later pieces are dropped and
// finish() tells the first one. It grows beside a file of that name, which it replaces in the end; one that
// was not finished leaves nothing.
class FileWriter {
  public:
    static FileResult<FileWriter> create(const std::string& path);
    FileWriter(FileWriter&& other) noexcept;
    FileWriter& operator=(FileWriter&&) = delete;
    ~FileWriter();

    void write(std::string_view bytes);
    // Hands everything to the system and closes the file.
    FileResult<void> finish();

  private:
    FileWriter(std::string path, int descriptor);
    void flush(std::string_view bytes);

    std::string path_;
    int descriptor_ = -1;
    bool removable_ = false;  // grows beside; a device is written as it is
    int error_number_ = 0;
    std::string buffer_;
};

// A whole small file at once.
FileResult<void> write_file(const std::string& path, std::string_view bytes);

}  // namespace tribo::files
