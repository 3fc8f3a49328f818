// SPDX-License-Identifier: MIT
// The disk, but one file has another text.
#pragma once

#include <string>
#include <utility>

#include "files/disk_source.hpp"

namespace tribo::app {

class EditedSource final : public job::FileSource {
  public:
    EditedSource(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {}

    FileResult<std::string> read(const std::string& path, std::uint64_t limit_bytes) const override {
        if (path == file_) return text_;
        return disk_.read(path, limit_bytes);
    }
    FileResult<readers::Model> read_model(const readers::ModelFile& file) const override {
        return disk_.read_model(file);
    }
    FileResult<job::StockSource> stock_source(const std::string& path) const override {
        return disk_.stock_source(path);
    }
    std::string identity(const std::string& path) const override { return disk_.identity(path); }

  private:
    std::string file_, text_;
    files::DiskSource disk_;
};

}  // namespace tribo::app
