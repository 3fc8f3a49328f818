// SPDX-License-Identifier: MIT
#include "files/sibling.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace tribo::files {
namespace {

namespace fs = std::filesystem;

// No pipe: opening one would wait for its writer. No link: it may lead anywhere.
constexpr int kLookOnly = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;

bool is_abandoned(const std::string& path) {
    struct stat status = {};
    if (::lstat(path.c_str(), &status) != 0) return false;
    if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return false;
    const int descriptor = ::open(path.c_str(), kLookOnly);
    if (descriptor < 0) return false;
    const bool free = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    ::close(descriptor);
    return free;
}

}  // namespace

std::string sibling_prefix(const std::string& base, const char* kind) {
    return "." + base + ".tribo-" + kind + "-";
}

std::string random_sibling(const std::string& prefix) {
    std::uint64_t number = 0;
    while (::getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number)) {
    }
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(number));
    return prefix + digits;
}

bool hold_sibling(int descriptor, const std::string& path) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
    struct stat held = {}, seen = {};
    return ::fstat(descriptor, &held) == 0 && ::lstat(path.c_str(), &seen) == 0 &&
           held.st_ino == seen.st_ino && held.st_dev == seen.st_dev;
}

std::vector<std::string> abandoned_siblings(const std::string& folder, const std::string& prefix) {
    std::vector<std::string> found;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (!it->path().filename().string().starts_with(prefix)) continue;
        if (is_abandoned(it->path().string())) found.push_back(it->path().string());
    }
    return found;
}

int sync_descriptor(int descriptor) {
    if (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP) return 0;
    return errno;
}

}  // namespace tribo::files
