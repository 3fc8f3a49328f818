// SPDX-License-Identifier: MIT
#include "files/unfinished.hpp"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace tribo::files {
namespace {

// A thread that still writes into a folder can make its removal fail.
constexpr int kTries = 10;

// Never destroyed: a thread may ask for it while the process ends.
struct Unfinished {
    std::mutex mutex;
    std::vector<std::pair<std::string, Removal>> paths;
};

Unfinished& unfinished() {
    static Unfinished& all = *new Unfinished;
    return all;
}

bool remove(const std::string& path, Removal removal) {
    if (removal == Removal::if_empty) return ::rmdir(path.c_str()) == 0;
    std::error_code error;
    std::filesystem::remove_all(path, error);
    return !error;
}

}  // namespace

void note_unfinished(const std::string& path, Removal removal) {
    const std::lock_guard lock(unfinished().mutex);
    unfinished().paths.emplace_back(path, removal);
}

void forget_unfinished(const std::string& path) {
    const std::lock_guard lock(unfinished().mutex);
    std::erase_if(unfinished().paths, [&](const auto& noted) { return noted.first == path; });
}

void remove_unfinished() {
    unfinished().mutex.lock();
    const auto& paths = unfinished().paths;
    for (auto at = paths.rbegin(); at != paths.rend(); ++at) {
        for (int n = 0; n < kTries && !remove(at->first, at->second); ++n) {
        }
    }
}

}  // namespace tribo::files
