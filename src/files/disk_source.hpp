// SPDX-License-Identifier: MIT
// A job's files on the disk.
#pragma once

#include <string>

#include "job/file_source.hpp"

namespace tribo::files {

class DiskSource final : public job::FileSource {
  public:
    FileResult<std::string> read(const std::string& path, std::uint64_t limit_bytes) const override;
    // Models of every format; see model/model_file.hpp.
    FileResult<readers::Model> read_model(const readers::ModelFile& file) const override;
    // A job file, or the folder of its render.
    FileResult<job::StockSource> stock_source(const std::string& path) const override;
    // Absolute, with links in its folders resolved. A link to a job stays: what the job names is found from
    // where the link stands.
    std::string identity(const std::string& path) const override;
};

// `file` as it is called from within `folder`.
std::string relative_to(const std::string& folder, const std::string& file);

}  // namespace tribo::files
