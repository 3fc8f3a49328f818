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
#include <vector>

namespace tribo::files {
namespace {

namespace fs = std::filesystem;

// No pipe: opening one would wait for its writer. No link: it may lead anywhere.
constexpr int kLookOnly = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;

// A descriptor that holds the lock of an abandoned sibling; -1 where a living process holds it, or where it
// is no file or folder.
int lock_abandoned(const std::string& path) {
    struct stat status = {};
    if (::lstat(path.c_str(), &status) != 0) return -1;
    if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return -1;
    const int descriptor = ::open(path.c_str(), kLookOnly);
    if (descriptor < 0) return -1;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
    ::close(descriptor);
    return -1;
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

void visit_abandoned(const std::string& folder, const std::string& prefix,
                     const std::function<void(const std::string&)>& visit) {
    std::vector<std::string> siblings;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (it->path().filename().string().starts_with(prefix)) siblings.push_back(it->path().string());
    for (const std::string& sibling : siblings) {
        const int lock = lock_abandoned(sibling);
        if (lock < 0) continue;
        visit(sibling);
        ::close(lock);
    }
}

int sync_descriptor(int descriptor) {
    if (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP) return 0;
    return errno;
}

}  // namespace tribo::files
