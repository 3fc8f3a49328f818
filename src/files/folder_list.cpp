// SPDX-License-Identifier: MIT
#include "files/folder_list.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <sstream>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace tribo::files {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFirstLine = "files of one run of tribo: a later run into this folder removes them";
constexpr std::uint64_t kLargestListBytes = std::uint64_t{64} << 20;

std::string relative(const fs::path& path, const std::string& dir) {
    return path.lexically_relative(dir).generic_string();
}

std::error_code copy_one(const fs::path& from, const fs::path& to) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(from, error);
    if (fs::is_directory(status)) {
        fs::create_directories(to, error);
    } else if (::link(from.c_str(), to.c_str()) == 0) {
        error.clear();
    } else if (errno == EEXIST) {
        error.assign(EEXIST, std::generic_category());
    } else if (fs::is_symlink(status)) {
        fs::copy_symlink(from, to, error);
    } else {
        fs::copy_file(from, to, error);
    }
    return error;
}

}  // namespace

FileResult<void> write_folder_list(const std::string& dir) {
    const FileResult<std::vector<std::string>> files = files_of_others(dir, {});
    if (!files) return std::unexpected(files.error());
    std::string text = std::string(kFirstLine) + "\n";
    for (const std::string& file : *files) text += file + "\n";
    return write_file(dir + "/" + kFolderList, text);
}

std::set<std::string> read_folder_list(const std::string& dir) {
    const std::string path = dir + "/" + kFolderList;
    struct stat status = {};
    if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
    const FileResult<std::string> text = read_file(path, kLargestListBytes);
    if (!text) return {};
    std::istringstream lines(*text);
    std::string line;
    if (!std::getline(lines, line) || line != kFirstLine) return {};
    std::set<std::string> names{kFolderList};
    while (std::getline(lines, line)) names.insert(line);
    return names;
}

FileResult<std::vector<std::string>> files_of_others(const std::string& dir,
                                                     const std::set<std::string>& listed) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::recursive_directory_iterator it(dir, error), end; !error && it != end; it.increment(error)) {
        const std::string name = relative(it->path(), dir);
        const fs::file_status status = it->symlink_status(error);
        if (error) break;
        if (fs::is_directory(status) && !fs::is_empty(it->path(), error)) continue;
        if (error) break;
        if (!listed.contains(name)) names.push_back(name);
    }
    if (error) return system_failure(dir, "look at the output folder", error.value());
    std::sort(names.begin(), names.end());
    return names;
}

FileResult<void> keep_files(const std::vector<std::string>& names, const std::string& from,
                            const std::string& to) {
    for (const std::string& name : names) {
        const fs::path target = fs::path(to) / name;
        std::error_code error;
        fs::create_directories(target.parent_path(), error);
        if (!error) error = copy_one(fs::path(from) / name, target);
        if (error == std::errc::file_exists || error == std::errc::not_a_directory) {
            return std::unexpected(FileFailure({from + "/" + name, 0, 0,
                                                "is not a file of the earlier run and stands in the way",
                                                "move it, or name another folder"}));
        }
        if (error) return system_failure(from + "/" + name, "keep", error.value());
    }
    return {};
}

}  // namespace tribo::files
