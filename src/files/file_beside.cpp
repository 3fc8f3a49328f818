// SPDX-License-Identifier: MIT
#include "files/file_beside.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tribo::files {

std::string name_beside(const std::string& path) {
    return path + ".part";
}

FileResult<FileBeside> open_beside(const std::string& path) {
    FileBeside file;
    struct stat status = {};
    const bool there = ::lstat(path.c_str(), &status) == 0;
    // The system refuses a folder and a file without write permission.
    file.beside = !there || (S_ISREG(status.st_mode) && ::access(path.c_str(), W_OK) == 0);
    if (path.empty() || path.ends_with('/')) file.beside = false;
    const std::string name = file.beside ? name_beside(path) : path;
    file.descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file.descriptor < 0) return system_failure(path, "write", errno);
    return file;
}

int take_name(const std::string& path) {
    if (std::rename(name_beside(path).c_str(), path.c_str()) == 0) return 0;
    const int error_number = errno;
    ::unlink(name_beside(path).c_str());
    return error_number;
}

}  // namespace tribo::files
