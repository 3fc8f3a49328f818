// SPDX-License-Identifier: MIT
// A file that takes its name only when it is whole. Until then it is a hidden sibling with a random name, so
// that two writers of one file never share bytes and an interrupted one leaves the old file as it was.
#pragma once

#include <string>

#include "files/files.hpp"

namespace tribo::files {

// The sibling of NAME is `.NAME.tribo-part-RANDOM`. It is locked (flock) while its writer lives: open()
// removes those that killed writers left. A device, a pipe and a link to one of these are written directly.
class PendingFile {
  public:
    // `path` is the name that the file will take. A symbolic link stays; the file that it names is replaced.
    static FileResult<PendingFile> open(const std::string& path);
    PendingFile(PendingFile&& other) noexcept;
    PendingFile& operator=(PendingFile&&) = delete;
    // Without a commit nothing is left.
    ~PendingFile();

    int descriptor() const { return descriptor_; }
    // Sends the bytes to the disk, closes the file and gives it its name. Returns 0 or the error number.
    int commit();

  private:
    PendingFile() = default;
    void discard();

    std::string target_, sibling_;  // no sibling: written directly
    int descriptor_ = -1;
};

}  // namespace tribo::files
