// SPDX-License-Identifier: MIT
// A memory-mapped file: pages are read at first use, and unused pages may be dropped.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "files/files.hpp"

namespace tribo::files {

// The bytes of a regular file, aligned to a page. They live as long as the object. The file must not be
// truncated meanwhile; writers must replace it by a new file instead.
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

// Writes a whole file beside `path` and renames it. Existing mappings of the old file stay valid.
FileResult<void> replace_file(const std::string& path, std::string_view bytes);

}  // namespace tribo::files
