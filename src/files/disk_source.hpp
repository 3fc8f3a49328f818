// SPDX-License-Identifier: MIT
// The files of a job on the disk.
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "files/files.hpp"
#include "job/file_source.hpp"

namespace tribo::files {

// Any thread.
class DiskSource final : public job::FileSource {
  public:
    explicit DiskSource(Pipes pipes = Pipes::read) : policy_(pipes) {}

    // A pipe gives its text once; it is kept, so that a source gives it again.
    FileResult<std::string> read(const std::string& path, std::uint64_t limit_bytes) const override;
    // Models of every format; see model/model_file.hpp.
    FileResult<readers::Model> read_model(const readers::ModelFile& file) const override;
    // A job file, or the folder of its render.
    FileResult<job::StockSource> stock_source(const std::string& path) const override;
    // Returns an absolute path with resolved links in its folders. A link to a job file is kept: the files
    // named by the job are searched relative to the link.
    std::string identity(const std::string& path) const override;

  private:
    Pipes policy_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, std::string> pipes_;  // the text of each pipe, by name
};

// Returns `file` relative to `folder`.
std::string relative_to(const std::string& folder, const std::string& file);

}  // namespace tribo::files
