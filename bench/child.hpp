// SPDX-License-Identifier: MIT
// A program as a user runs it: a process with its time and memory.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tribo::bench {

struct Cost {
    double seconds = 0, processor_s = 0, peak_mb = 0;
};

// Runs a program on at most two processors; its output goes to the file `log`. Nothing if it failed; `log`
// then says why. A child's peak memory starts from what this process holds at the fork.
std::optional<Cost> run(const std::string& program, const std::vector<std::string>& arguments,
                        const std::string& log);

// A folder that is removed in the end; its path is empty if there is none.
class TemporaryFolder {
  public:
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace tribo::bench
