// SPDX-License-Identifier: MIT
// Where a job's files are: on a disk (files/disk_source.hpp), or in memory (job/memory_source.hpp), where a
// page has dropped them or a test has written them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/file_result.hpp"
#include "job/stock_record.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::job {

// What `[stock] from` names.
struct StockSource {
    std::string job;                    // the earlier job's file, as FileSource::read() takes it
    std::optional<StockRecord> record;  // where the folder of its render was named
    std::string folder;                 // that folder, absolute, links resolved; else empty
};

class FileSource {
  public:
    virtual ~FileSource() = default;

    // The bytes of a file. Refuses more than `limit_bytes` before any memory is taken for them.
    virtual FileResult<std::string> read(const std::string& path, std::uint64_t limit_bytes) const = 0;
    // A model of any format that the source reads, with the files that it names itself.
    virtual FileResult<readers::Model> read_model(const readers::ModelFile& file) const = 0;
    // An error without a file is about the key that names the path: the caller knows its place.
    virtual FileResult<StockSource> stock_source(const std::string& path) const = 0;
    // Equal for two names that are surely one file.
    virtual std::string identity(const std::string& path) const = 0;
};

}  // namespace tribo::job
