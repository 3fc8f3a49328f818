// SPDX-License-Identifier: MIT
// A file's bytes as memory: nothing is read until it is used, and what is not used again may leave.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "files/files.hpp"

namespace tribo::files {

// The bytes of a regular file, aligned to a page; they live as long as the object. The file must not be cut
// short meanwhile: whoever writes one puts a new one in its place.
class MappedFile {
  public:
    static FileResult<std::shared_ptr<const MappedFile>> open(const std::string& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::string_view bytes() const { return bytes_; }

  private:
    explicit MappedFile(std::string_view bytes) : bytes_(bytes) {}
    std::string_view bytes_;
};

// Writes a whole file beside `path` and renames it: whoever has the old one mapped keeps it.
FileResult<void> replace_file(const std::string& path, std::string_view bytes);

}  // namespace tribo::files
