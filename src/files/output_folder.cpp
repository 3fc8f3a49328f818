// SPDX-License-Identifier: MIT
#include "files/output_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace tribo::files {
namespace {

namespace fs = std::filesystem;

constexpr int kPartialNames = 1000;  // names tried; each is free unless this process uses it

std::string partial_prefix(const std::string& base) {
    return "." + base + ".tribo-partial-";
}
std::string older_prefix(const std::string& base) {
    return "." + base + ".tribo-older-";
}

std::unexpected<FileFailure> refuse(const std::string& shown, std::string cause, std::string remedy) {
    return std::unexpected(FileFailure({shown, 0, 0, std::move(cause), std::move(remedy)}));
}

// True when the mark in the folder says that Tribo made it.
bool is_marked(const std::string& dir, const FolderMark& mark) {
    const FileResult<std::string> text = read_file(dir + "/" + mark.file);
    if (!text) return false;
    const std::size_t key = text->find("\"schema\"");
    if (key == std::string::npos) return false;
    const std::size_t value = text->find_first_not_of(" \t\r\n:", key + 8);
    return value != std::string::npos &&
           text->compare(value, mark.schema.size() + 1, "\"" + mark.schema) == 0;
}

// Checks the current content of `target`. Nothing, an empty folder, or a folder of Tribo may be replaced.
FileResult<void> check_replaceable(const std::string& target, const std::string& shown,
                                   const FolderMark& mark) {
    struct stat status = {};
    if (::lstat(target.c_str(), &status) != 0) {
        if (errno == ENOENT) return {};
        return system_failure(shown, "look at the output folder", errno);
    }
    if (S_ISLNK(status.st_mode)) {
        return refuse(shown, "the output folder is a symbolic link", "name the folder itself or a new one");
    }
    if (!S_ISDIR(status.st_mode)) {
        return refuse(shown, "the output folder is an existing file", "name a new folder");
    }
    std::error_code error;
    const bool empty = fs::is_empty(target, error);
    if (error) return system_failure(shown, "look at the output folder", error.value());
    if (empty || is_marked(target, mark)) return {};
    return refuse(shown,
                  "the folder exists and is not one that tribo wrote (no " + mark.file + " of its own in it)",
                  "name a new folder, or remove this one first");
}

// True when no running process holds the folder.
bool is_orphan(const std::string& dir) {
    const int descriptor = ::open(dir.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) return false;
    const bool free = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    ::close(descriptor);
    return free;
}

// Removes the folders that killed runs left beside the target. A folder that was moved aside and not replaced
// is moved back.
void clean_siblings(const std::string& parent, const std::string& base, const std::string& target) {
    std::error_code error;
    std::vector<std::string> partial, older;
    for (fs::directory_iterator it(parent, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        if (name.starts_with(partial_prefix(base))) partial.push_back(it->path().string());
        if (name.starts_with(older_prefix(base))) older.push_back(it->path().string());
    }
    for (const std::string& dir : older) {
        if (!is_orphan(dir)) continue;
        struct stat status = {};
        if (::lstat(target.c_str(), &status) != 0 && errno == ENOENT) {
            fs::rename(dir, target, error);
        } else {
            fs::remove_all(dir, error);
        }
    }
    for (const std::string& dir : partial) {
        if (is_orphan(dir)) fs::remove_all(dir, error);
    }
}

// Creates the missing parent folders of `dir` and lists them in `made`, outermost first.
FileResult<void> make_folders(const fs::path& dir, const std::string& shown, std::vector<std::string>& made) {
    std::vector<fs::path> missing;
    for (fs::path at = dir; !at.empty(); at = at.parent_path()) {
        struct stat status = {};
        if (::stat(at.c_str(), &status) == 0) {
            if (!S_ISDIR(status.st_mode)) return system_failure(shown, "make the output folder", ENOTDIR);
            break;
        }
        if (errno != ENOENT) return system_failure(shown, "make the output folder", errno);
        missing.push_back(at);
        if (at == at.parent_path()) break;
    }
    for (auto at = missing.rbegin(); at != missing.rend(); ++at) {
        if (::mkdir(at->c_str(), 0777) == 0) {
            made.push_back(at->string());
        } else if (errno != EEXIST) {
            return system_failure(shown, "make the output folder", errno);
        }
    }
    return {};
}

int sync_path(const std::string& path, int flags) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | flags);
    if (descriptor < 0) return errno;
    // A file system without sync (EINVAL, ENOTSUP) offers nothing more durable.
    int error = ::fsync(descriptor) == 0 ? 0 : errno;
    if (error == EINVAL || error == ENOTSUP) error = 0;
    ::close(descriptor);
    return error;
}

}  // namespace

FileResult<OutputFolder> OutputFolder::open(const std::string& dir, FolderMark mark) {
    if (dir.empty()) return refuse("", "the output folder's name is empty", "name a folder after --out");
    OutputFolder folder;
    folder.shown_ = dir;
    folder.mark_ = std::move(mark);

    std::error_code error;
    fs::path path = fs::absolute(dir, error).lexically_normal();
    if (error) return system_failure(dir, "find the output folder", error.value());
    if (!path.has_filename()) path = path.parent_path();
    if (!path.has_filename())
        return refuse(dir, "the output folder is the root of the file system", "name a folder");
    if (auto made = make_folders(path.parent_path(), dir, folder.made_parents_); !made) {
        return std::unexpected(std::move(made).error());
    }
    const std::string parent = fs::canonical(path.parent_path(), error).string();
    if (error) return system_failure(dir, "find the output folder", error.value());
    const std::string base = path.filename().string();
    folder.target_ = (fs::path(parent) / base).string();

    clean_siblings(parent, base, folder.target_);
    if (auto free = check_replaceable(folder.target_, dir, folder.mark_); !free) {
        return std::unexpected(std::move(free).error());
    }
    if (auto made = folder.make_partial(parent, base); !made) return std::unexpected(std::move(made).error());
    return folder;
}

FileResult<void> OutputFolder::make_partial(const std::string& parent, const std::string& base) {
    for (int i = 0; i < kPartialNames; ++i) {
        const std::string candidate =
            (fs::path(parent) / (partial_prefix(base) + std::to_string(::getpid()) + "-" + std::to_string(i)))
                .string();
        if (::mkdir(candidate.c_str(), 0777) != 0) {
            if (errno == EEXIST) continue;
            return system_failure(shown_, "make the output folder", errno);
        }
        const int descriptor = ::open(candidate.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (descriptor < 0) continue;  // a cleaning run took it for an orphan
        const bool taken = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        struct stat held = {}, seen = {};
        const bool same = ::fstat(descriptor, &held) == 0 && ::lstat(candidate.c_str(), &seen) == 0 &&
                          held.st_ino == seen.st_ino && held.st_dev == seen.st_dev;
        if (!taken && same) {
            partial_ = candidate;
            lock_ = descriptor;
            return {};
        }
        ::close(descriptor);
    }
    return system_failure(shown_, "make the output folder", EEXIST);
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : shown_(std::move(other.shown_)),
      target_(std::move(other.target_)),
      partial_(std::move(other.partial_)),
      mark_(std::move(other.mark_)),
      made_parents_(std::move(other.made_parents_)),
      lock_(std::exchange(other.lock_, -1)) {
    other.partial_.clear();
    other.made_parents_.clear();
}

OutputFolder::~OutputFolder() {
    std::error_code error;
    if (!partial_.empty()) fs::remove_all(partial_, error);
    for (auto at = made_parents_.rbegin(); at != made_parents_.rend(); ++at) ::rmdir(at->c_str());
    if (lock_ >= 0) ::close(lock_);
}

FileResult<void> OutputFolder::commit() {
    std::error_code error;
    for (fs::recursive_directory_iterator it(partial_, error), end; !error && it != end;
         it.increment(error)) {
        if (!it->is_regular_file(error)) continue;
        if (const int number = sync_path(it->path().string(), 0))
            return system_failure(shown_, "write", number);
    }
    if (error) return system_failure(shown_, "write", error.value());
    if (const int number = sync_path(partial_, O_DIRECTORY)) return system_failure(shown_, "write", number);

    // The target may have changed during the run.
    if (auto free = check_replaceable(target_, shown_, mark_); !free)
        return std::unexpected(std::move(free).error());
    std::string left_over;  // the older folder, moved aside
    if (::rename(partial_.c_str(), target_.c_str()) != 0) {
        if (errno != ENOTEMPTY && errno != EEXIST)
            return system_failure(shown_, "put the output folder in place", errno);
        if (::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) {
            left_over = partial_;
        } else {
            // Without the exchange in the file system there is no folder for a moment; clean_siblings()
            // handles this state.
            const fs::path target(target_);
            left_over = (target.parent_path() /
                         (older_prefix(target.filename().string()) + std::to_string(::getpid())))
                            .string();
            if (::rename(target_.c_str(), left_over.c_str()) != 0) {
                return system_failure(shown_, "move the older output folder away", errno);
            }
            if (::rename(partial_.c_str(), target_.c_str()) != 0) {
                const int number = errno;
                ::rename(left_over.c_str(), target_.c_str());
                return system_failure(shown_, "put the output folder in place", number);
            }
        }
    }
    partial_.clear();
    made_parents_.clear();
    sync_path(fs::path(target_).parent_path().string(),
              O_DIRECTORY);  // the new name exists even if this fails
    if (!left_over.empty()) fs::remove_all(left_over, error);
    return {};
}

}  // namespace tribo::files
