// SPDX-License-Identifier: MIT
// Files in memory: dropped into a page, or written by a test.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "job/file_source.hpp"

namespace tribo::job {

class MemorySource final : public FileSource {
  public:
    MemorySource() = default;
    explicit MemorySource(std::map<std::string, std::string> files) : files_(std::move(files)) {}

    // Names may hold folders ("bowl/bowl.csv"). A file of that name is replaced.
    void put(std::string name, std::string bytes);
    void clear();

    FileResult<std::string> read(const std::string& path, std::uint64_t limit_bytes) const override;
    // glTF is refused: its reader needs a library that the page's module does without.
    FileResult<readers::Model> read_model(const readers::ModelFile& file) const override;
    // Earlier jobs alone: no folder of a render is among the files.
    FileResult<StockSource> stock_source(const std::string& path) const override;
    std::string identity(const std::string& path) const override { return path; }

  private:
    FileResult<std::string_view> find(const std::string& path) const;

    std::map<std::string, std::string> files_;
};

}  // namespace tribo::job
