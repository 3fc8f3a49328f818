// SPDX-License-Identifier: MIT
// Reads and writes whole files. Nothing here throws. Every error says whether the caller named something
// wrong or the system refused, because these have different exit codes.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/file_result.hpp"

namespace tribo::files {

// Converts the error number of a failed system call for `file`. `doing` completes "cannot ...: ".
std::unexpected<FileFailure> system_failure(const std::string& file, const char* doing, int error_number);

// Text formats are read whole. A larger file is refused before memory is allocated for it.
inline constexpr std::uint64_t kLargestInputBytes = std::uint64_t{2} << 30;

// A program that reads its files again and again refuses pipes: they can be read once, and they block.
enum class Pipes { read, refuse };

// Returns the bytes of a regular file or of a pipe.
FileResult<std::string> read_file(const std::string& path, std::uint64_t limit_bytes = kLargestInputBytes,
                                  Pipes pipes = Pipes::read);

// Returns the first bytes of a file, at most so many. The file does not count as read.
FileResult<std::string> first_bytes(const std::string& path, std::size_t most);

// True if this process has read the regular file with read_file(), under whatever name. Any thread.
bool was_read(const std::string& path);

// How a file looked when it was read, to see later whether it has changed. All 0: it was not there.
struct FileStamp {
    std::uint64_t device = 0, number = 0, size = 0;
    std::int64_t changed_ns = 0;
    bool operator==(const FileStamp&) const = default;
};
using FileStamps = std::map<std::string, FileStamp>;  // by the name that was given

// Of all that this process has given to read_file(), each at its last time. Any thread.
FileStamps stamps_of_files_read();
// True if one of them looks otherwise now, or has come or gone. Any thread.
bool have_changed(const FileStamps& stamps);

class PendingFile;

// Writes a new file in pieces through one buffer. After a failure later pieces are dropped, and finish()
// returns the first error. A file of that name is replaced at the end (PendingFile). An unfinished file
// leaves nothing.
class FileWriter {
  public:
    static FileResult<FileWriter> create(const std::string& path);
    FileWriter(FileWriter&& other) noexcept;
    FileWriter& operator=(FileWriter&&) = delete;
    ~FileWriter();

    void write(std::string_view bytes);
    // Sends everything to the disk and gives the file its name.
    FileResult<void> finish();

  private:
    FileWriter(std::string path, PendingFile file);
    void flush(std::string_view bytes);

    std::string path_;
    std::unique_ptr<PendingFile> file_;
    int error_number_ = 0;
    std::string buffer_;
};

// Writes a small file at once.
FileResult<void> write_file(const std::string& path, std::string_view bytes);

}  // namespace tribo::files
