// SPDX-License-Identifier: MIT
#include "files/mapped_file.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tribo::files {

FileResult<std::shared_ptr<const MappedFile>> MappedFile::open(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return system_failure(path, "open it", errno);
    struct stat status{};
    const bool known = ::fstat(descriptor, &status) == 0;
    const int error = errno;
    std::string_view bytes;
    bool mapped = known && S_ISREG(status.st_mode);
    if (mapped && status.st_size > 0) {
        const auto size = static_cast<std::size_t>(status.st_size);
        void* memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
        mapped = memory != MAP_FAILED;
        if (mapped) bytes = {static_cast<const char*>(memory), size};
    }
    const int map_error = errno;
    ::close(descriptor);
    if (!known) return system_failure(path, "look at it", error);
    if (!S_ISREG(status.st_mode))
        return std::unexpected(FileFailure({path, 0, 0, "this is not a plain file", "name a file"}));
    if (!mapped) return system_failure(path, "map it into memory", map_error);
    return std::shared_ptr<const MappedFile>(new MappedFile(bytes));
}

MappedFile::~MappedFile() {
    if (!bytes_.empty()) ::munmap(const_cast<char*>(bytes_.data()), bytes_.size());
}

FileResult<void> replace_file(const std::string& path, std::string_view bytes) {
    const std::string beside = path + ".tribo-" + std::to_string(::getpid());
    if (auto written = write_file(beside, bytes); !written) {
        FileFailure failure = written.error();
        failure.file = path;
        return std::unexpected(failure);
    }
    if (std::rename(beside.c_str(), path.c_str()) == 0) return {};
    const int error = errno;
    ::unlink(beside.c_str());
    return system_failure(path, "put it in place", error);
}

}  // namespace tribo::files
