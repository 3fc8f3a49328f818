// SPDX-License-Identifier: MIT
#include "files/output_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <stdio.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "files/folder_list.hpp"
#include "files/sibling.hpp"
#include "files/unfinished.hpp"

namespace tribo::files {
namespace {

namespace fs = std::filesystem;

constexpr int kPartialNames = 100;  // tried before giving up: a run that cleans may take a new one

std::string partial_prefix(const std::string& base) {
    return sibling_prefix(base, "partial");
}
std::string older_prefix(const std::string& base) {
    return sibling_prefix(base, "older");
}

std::unexpected<FileFailure> refuse(const std::string& shown, std::string cause, std::string remedy) {
    return std::unexpected(FileFailure({shown, 0, 0, std::move(cause), std::move(remedy)}));
}

// Checks what stands at `target` now: nothing, an empty folder or a folder of an earlier run.
FileResult<void> check_replaceable(const std::string& target, const std::string& shown) {
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
    if (empty || !read_folder_list(target).empty()) return {};
    return refuse(
        shown,
        std::string("the folder exists and is not one that tribo wrote (no list ") + kFolderList + " in it)",
        "name a new folder, or remove this one first");
}

// Refuses a file of the user's that the run would replace.
FileResult<void> check_names(const std::string& target, const std::string& shown,
                             const OutputFolder::Writes& writes) {
    std::error_code error;
    if (!fs::is_directory(fs::symlink_status(target, error))) return {};
    const FileResult<std::vector<std::string>> others = files_of_others(target, read_folder_list(target));
    if (!others) return std::unexpected(others.error());
    for (const std::string& name : *others) {
        if (!writes(name)) continue;
        return refuse(std::string(shown).append("/").append(name),
                      "tribo did not write this file and would replace it",
                      "move it, or name another folder");
    }
    return {};
}

// Removes the folders that killed runs left beside the target. A folder that was moved aside and not replaced
// is moved back.
void clean_siblings(const std::string& parent, const std::string& base, const std::string& target) {
    std::error_code error;
    visit_abandoned(parent, older_prefix(base), [&](const std::string& dir) {
        struct stat status = {};
        if (::lstat(target.c_str(), &status) != 0 && errno == ENOENT) {
            fs::rename(dir, target, error);
        } else {
            fs::remove_all(dir, error);
        }
    });
    visit_abandoned(parent, partial_prefix(base),
                    [&](const std::string& dir) { fs::remove_all(dir, error); });
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
            note_unfinished(made.back(), Removal::if_empty);
        } else if (errno != EEXIST) {
            return system_failure(shown, "make the output folder", errno);
        }
    }
    return {};
}

int sync_path(const std::string& path, int flags) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | flags);
    if (descriptor < 0) return errno;
    const int error = sync_descriptor(descriptor);
    ::close(descriptor);
    return error;
}

}  // namespace

FileResult<OutputFolder> OutputFolder::open(const std::string& dir, const Writes& writes) {
    if (dir.empty()) return refuse("", "the output folder's name is empty", "name a folder after --out");
    OutputFolder folder;
    folder.shown_ = dir;

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
    if (auto free = check_replaceable(folder.target_, dir); !free)
        return std::unexpected(std::move(free).error());
    if (auto free = check_names(folder.target_, dir, writes); !free)
        return std::unexpected(std::move(free).error());
    if (auto made = folder.make_partial(parent, base); !made) return std::unexpected(std::move(made).error());
    return folder;
}

FileResult<void> OutputFolder::make_partial(const std::string& parent, const std::string& base) {
    for (int i = 0; i < kPartialNames; ++i) {
        const std::string candidate = (fs::path(parent) / random_sibling(partial_prefix(base))).string();
        note_unfinished(candidate, Removal::with_contents);
        const int error_number = ::mkdir(candidate.c_str(), 0777) == 0 ? 0 : errno;
        if (error_number == 0) {
            // Without a descriptor or a lock, a run that was cleaning took it for abandoned.
            const int descriptor = ::open(candidate.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
            if (descriptor >= 0 && hold_sibling(descriptor, candidate)) {
                partial_ = candidate;
                lock_ = descriptor;
                return {};
            }
            if (descriptor >= 0) ::close(descriptor);
        }
        forget_unfinished(candidate);
        if (error_number != 0 && error_number != EEXIST)
            return system_failure(shown_, "make the output folder", error_number);
    }
    return system_failure(shown_, "make the output folder", EEXIST);
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : shown_(std::move(other.shown_)),
      target_(std::move(other.target_)),
      partial_(std::move(other.partial_)),
      made_parents_(std::move(other.made_parents_)),
      lock_(std::exchange(other.lock_, -1)) {
    other.partial_.clear();
    other.made_parents_.clear();
}

OutputFolder::~OutputFolder() {
    std::error_code error;
    if (!partial_.empty()) fs::remove_all(partial_, error);
    for (auto at = made_parents_.rbegin(); at != made_parents_.rend(); ++at) ::rmdir(at->c_str());
    forget();
    if (lock_ >= 0) ::close(lock_);
}

void OutputFolder::forget() {
    if (!partial_.empty()) files::forget_unfinished(partial_);
    for (const std::string& made : made_parents_) files::forget_unfinished(made);
}

FileResult<void> OutputFolder::commit() {
    if (auto listed = write_folder_list(partial_); !listed) return listed;
    std::error_code error;
    for (fs::recursive_directory_iterator it(partial_, error), end; !error && it != end;
         it.increment(error)) {
        if (!it->is_regular_file(error)) continue;
        if (const int number = sync_path(it->path().string(), 0))
            return system_failure(shown_, "write", number);
    }
    if (error) return system_failure(shown_, "write", error.value());

    // The folder may have changed during the run.
    if (auto free = check_replaceable(target_, shown_); !free) return free;
    if (const int number = sync_path(partial_, O_DIRECTORY)) return system_failure(shown_, "write", number);
    if (::rename(partial_.c_str(), target_.c_str()) != 0) {
        if (errno != ENOTEMPTY && errno != EEXIST)
            return system_failure(shown_, "put the output folder in place", errno);
        if (auto replaced = replace_target(); !replaced) return replaced;
    }
    forget();
    partial_.clear();
    made_parents_.clear();
    // The new name is there even if this fails.
    sync_path(fs::path(target_).parent_path().string(), O_DIRECTORY);
    return {};
}

// At every moment each file of the user's stands in the old folder, the new one, or both.
FileResult<void> OutputFolder::replace_target() {
    const std::set<std::string> listed = read_folder_list(target_);
    const auto keep = [&](const std::string& from, const std::string& to) -> FileResult<void> {
        const FileResult<std::vector<std::string>> others = files_of_others(from, listed);
        if (!others) return std::unexpected(others.error());
        return keep_files(*others, from, to);
    };
    if (auto kept = keep(target_, partial_); !kept) return kept;
    struct stat status = {};
    if (::stat(target_.c_str(), &status) == 0) (void)::chmod(partial_.c_str(), status.st_mode & 07777);
    if (const int number = sync_path(partial_, O_DIRECTORY)) return system_failure(shown_, "write", number);

    // From here on the partial name may stand for the older folder.
    forget();
    std::string older;  // the older folder, out of the way
    if (::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) {
        older = std::exchange(partial_, {});
    } else {
        // A file system without the exchange: for a moment there is no folder, and clean_siblings() knows.
        const fs::path target(target_);
        older = (target.parent_path() / random_sibling(older_prefix(target.filename().string()))).string();
        if (::rename(target_.c_str(), older.c_str()) != 0) {
            return system_failure(shown_, "move the older output folder away", errno);
        }
        if (::rename(partial_.c_str(), target_.c_str()) != 0) {
            const int number = errno;
            ::rename(older.c_str(), target_.c_str());
            return system_failure(shown_, "put the output folder in place", number);
        }
        partial_.clear();
    }
    // What came into the older folder since it was looked through.
    std::set<std::string> there = listed;
    if (const auto kept = files_of_others(target_, {})) there.insert(kept->begin(), kept->end());
    const FileResult<std::vector<std::string>> late = files_of_others(older, there);
    if (!late) return std::unexpected(late.error());
    if (auto kept = keep_files(*late, older, target_); !kept) return kept;
    std::error_code error;
    fs::remove_all(older, error);
    return {};
}

}  // namespace tribo::files
