// SPDX-License-Identifier: MIT
// The files of a sweep's jobs, read once, with a digest of all of their bytes.
#pragma once

#include <map>
#include <string>

#include "files/disk_source.hpp"

namespace tribo::app {

// SHA-256 of a text, 32 hexadecimal digits of it: two texts of equal digest do not occur.
std::string digest_of(std::string_view text);

// Keeps what it has read: a later change of a file does not mix into a sweep. One thread.
class SweepFiles final : public job::FileSource {
  public:
    FileResult<std::string> read(const std::string& path, std::uint64_t limit_bytes) const override;
    FileResult<readers::Model> read_model(const readers::ModelFile& file) const override;
    FileResult<job::StockSource> stock_source(const std::string& path) const override;
    std::string identity(const std::string& path) const override { return disk_.identity(path); }

    // Digest of the bytes of all files, in the order of their names, that were read since the last call of
    // begin_digest().
    std::string digest() const;
    void begin_digest() { used_.clear(); }

  private:
    void use(const std::string& path, std::string_view bytes) const;

    files::DiskSource disk_{files::Pipes::refuse};
    mutable std::map<std::string, std::string> texts_, digests_, used_;
    mutable std::map<std::pair<std::string, double>, readers::Model> models_;
};

}  // namespace tribo::app
