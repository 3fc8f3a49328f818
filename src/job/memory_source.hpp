// SPDX-License-Identifier: MIT
// Files in memory, for pages and tests.
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

    // Names may contain folders ("bowl/bowl.csv"). An existing file is replaced.
    void put(std::string name, std::string bytes);
    void clear();
    // The first file that is a tool table or library; empty: there is none.
    std::string tool_table() const;

    FileResult<std::string> read(const std::string& path, std::uint64_t limit_bytes) const override;
    // glTF is refused: the module of the page does not contain the library of its reader.
    FileResult<readers::Model> read_model(const readers::ModelFile& file) const override;
    // Only earlier jobs; render folders are not supported in memory.
    FileResult<StockSource> stock_source(const std::string& path) const override;
    std::string identity(const std::string& path) const override { return path; }

  private:
    FileResult<std::string_view> find(const std::string& path) const;

    std::map<std::string, std::string> files_;
};

}  // namespace tribo::job
