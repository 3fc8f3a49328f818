// SPDX-License-Identifier: MIT
// Source of the files of a job: a disk (files/disk_source.hpp), or memory (job/memory_source.hpp) with files
// from a page or a test.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/file_result.hpp"
#include "job/stock_record.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::job {

// The job that `[stock] from` names.
struct StockSource {
    std::string job;                    // file of the earlier job, for FileSource::read()
    std::optional<StockRecord> record;  // if the folder of its render is named
    std::string folder;                 // this folder, absolute, without links; else empty
};

class FileSource {
  public:
    virtual ~FileSource() = default;

    // Reads a file. Refuses more than `limit_bytes` before it allocates memory.
    virtual FileResult<std::string> read(const std::string& path, std::uint64_t limit_bytes) const = 0;
    // Reads a model in any supported format, with the files that it refers to.
    virtual FileResult<readers::Model> read_model(const readers::ModelFile& file) const = 0;
    // An error without a file belongs to the key with this path; the caller adds its place.
    virtual FileResult<StockSource> stock_source(const std::string& path) const = 0;
    // Equal for two names of the same file.
    virtual std::string identity(const std::string& path) const = 0;
};

}  // namespace tribo::job
