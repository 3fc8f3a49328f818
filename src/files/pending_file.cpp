// SPDX-License-Identifier: MIT
#include "files/pending_file.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "files/sibling.hpp"
#include "files/unfinished.hpp"

namespace tribo::files {
namespace {

namespace fs = std::filesystem;

constexpr int kNames = 100;  // tried before giving up: a run that cleans may take a new one for abandoned
constexpr mode_t kModeBits = 07777;

}  // namespace

FileResult<PendingFile> PendingFile::open(const std::string& path) {
    PendingFile file;
    struct stat status = {};
    const bool there = ::stat(path.c_str(), &status) == 0;
    struct stat link = {};
    const bool dangling = !there && ::lstat(path.c_str(), &link) == 0;
    // A folder, and a file that may not be written, are refused as the system refuses them.
    const bool replaces = there ? S_ISREG(status.st_mode) && ::access(path.c_str(), W_OK) == 0 : !dangling;
    if (!replaces || path.empty() || path.ends_with('/')) {
        file.descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (file.descriptor_ < 0) return system_failure(path, "write", errno);
        return file;
    }
    std::error_code error;
    const fs::path target = there ? fs::canonical(path, error) : fs::path(path);
    if (error) return system_failure(path, "write", error.value());
    file.target_ = target.string();
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    const std::string prefix = sibling_prefix(target.filename().string(), "part");
    visit_abandoned(folder.string(), prefix, [](const std::string& left) { ::unlink(left.c_str()); });
    for (int n = 0; n < kNames; ++n) {
        const std::string sibling = (folder / random_sibling(prefix)).string();
        // Noted first: a signal may come between the two.
        note_unfinished(sibling, Removal::with_contents);
        file.descriptor_ =
            ::open(sibling.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file.descriptor_ < 0) {
            const int error_number = errno;
            forget_unfinished(sibling);
            if (error_number == EEXIST) continue;
            return system_failure(path, "write", error_number);
        }
        file.sibling_ = sibling;
        if (hold_sibling(file.descriptor_, file.sibling_)) {
            // The new file may be read by those who may read the old one.
            if (there) (void)::fchmod(file.descriptor_, status.st_mode & kModeBits);
            return file;
        }
        file.discard();
    }
    return system_failure(path, "write", EEXIST);
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : target_(std::move(other.target_)),
      sibling_(std::exchange(other.sibling_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

PendingFile::~PendingFile() {
    discard();
}

void PendingFile::discard() {
    if (!sibling_.empty()) {
        ::unlink(sibling_.c_str());
        forget_unfinished(std::exchange(sibling_, {}));
    }
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

int PendingFile::commit() {
    int error_number = sibling_.empty() ? 0 : sync_descriptor(descriptor_);
    if (error_number == 0 && !sibling_.empty()) {
        // Renamed while the lock is held: nobody takes it for abandoned.
        if (std::rename(sibling_.c_str(), target_.c_str()) == 0) {
            forget_unfinished(std::exchange(sibling_, {}));
        } else {
            error_number = errno;
        }
    }
    if (::close(std::exchange(descriptor_, -1)) != 0 && error_number == 0 && errno != EINTR)
        error_number = errno;
    discard();
    return error_number;
}

}  // namespace tribo::files
