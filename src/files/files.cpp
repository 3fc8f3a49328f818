// SPDX-License-Identifier: MIT
#include "files/files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <set>
#include <sys/stat.h>
#include <unistd.h>

#include "files/pending_file.hpp"

namespace tribo::files {
namespace {

constexpr std::size_t kWriteBufferBytes = std::size_t{1} << 18;
constexpr std::size_t kReadStepBytes = std::size_t{1} << 20;  // for a pipe, whose length is unknown

// Closes a descriptor at the end of its scope.
struct Closing {
    int descriptor;
    ~Closing() { ::close(descriptor); }
};

// The regular files that were read: device and number, and their stamps.
struct FilesRead {
    std::mutex mutex;
    std::set<std::pair<dev_t, ino_t>> files;
    FileStamps stamps;
};

FileStamp stamp_of(const struct stat& status) {
    return {status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size),
            std::int64_t{1'000'000'000} * status.st_mtim.tv_sec + status.st_mtim.tv_nsec};
}

FilesRead& files_read() {
    static FilesRead& all = *new FilesRead;
    return all;
}

void remember(const std::string& path, const FileStamp& stamp) {
    const std::lock_guard lock(files_read().mutex);
    files_read().stamps[path] = stamp;
}

const char* remedy_for(int error_number, bool reading) {
    switch (error_number) {
        case ENOENT:
        case ENOTDIR:
            if (!reading) return "make the folder first, or try another";
            return "try the path again: it is taken from the folder in which the program runs, or from the "
                   "job file's";
        case EACCES:
        case EPERM:
            return "try another place, or change the permissions";
        case ENOSPC:
        case EDQUOT:
            return "free some space or try another disk";
        case EFBIG:
            return "raise the limit on file sizes (ulimit -f) or write less with --only or a coarser "
                   "--resolution";
        case EROFS:
            return "try a place that can be written to";
        case ELOOP:
            return "its links lead in a circle; name the file itself";
        case ENAMETOOLONG:
            return "give it a shorter name: 255 bytes at most, 4095 with its folders";
        case EISDIR:
            return "name a file, not a folder";
        case EIO:
            return "the disk or the connection to it failed; check it, or try another one";
        case EMFILE:
        case ENFILE:
            return "raise the limit on open files (ulimit -n), or end other programs";
        case EPIPE:
            return "the program at the other end of the pipe has ended; let it read to the end";
        default:
            return "";
    }
}

bool names_something_wrong(int error_number) {
    switch (error_number) {
        case ENOENT:
        case ENOTDIR:
        case EISDIR:
        case ENAMETOOLONG:
        case ELOOP:
        case EINVAL:
            return true;
        default:
            return false;
    }
}

std::unexpected<FileFailure> too_long(const std::string& path, std::uint64_t limit_bytes) {
    const std::string limit = limit_bytes >= (std::uint64_t{1} << 20)
                                  ? std::to_string(limit_bytes >> 20) + " MB"
                                  : std::to_string(limit_bytes) + " bytes";
    return std::unexpected(
        FileFailure({path, 0, 0, "is longer than the " + limit + " that this kind of file may have",
                     "check that it is the right one"}));
}

// Reads to the end, or until `bytes` is full. Returns 0 or the error number.
int read_some(int descriptor, std::string& bytes, std::size_t& filled) {
    while (filled < bytes.size()) {
        const ssize_t got = ::read(descriptor, bytes.data() + filled, bytes.size() - filled);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return errno;
        if (got == 0) break;
        filled += static_cast<std::size_t>(got);
    }
    return 0;
}

}  // namespace

std::unexpected<FileFailure> system_failure(const std::string& file, const char* doing, int error_number) {
    const FileFault fault = error_number == ENOENT                ? FileFault::missing
                            : names_something_wrong(error_number) ? FileFault::input
                                                                  : FileFault::system;
    return std::unexpected(
        FileFailure({file, 0, 0, std::string("cannot ") + doing + ": " + std::strerror(error_number),
                     remedy_for(error_number, std::string_view(doing) == "read")},
                    fault));
}

FileResult<std::string> read_file(const std::string& path, std::uint64_t limit_bytes, Pipes pipes) {
    if (path.empty()) return std::unexpected(FileFailure({"", 0, 0, "a file name is empty", "name a file"}));
    if (path.find('\0') != std::string::npos) {
        return std::unexpected(FileFailure({"", 0, 0, "a file name holds a zero byte", "name a file"}));
    }
    // Without O_NONBLOCK the opening of a pipe waits for its writer.
    const int descriptor =
        ::open(path.c_str(), O_RDONLY | O_CLOEXEC | (pipes == Pipes::refuse ? O_NONBLOCK : 0));
    if (descriptor < 0) {
        const int error = errno;
        remember(path, {});
        return system_failure(path, "read", error);
    }
    const Closing closing{descriptor};
    struct stat status = {};
    if (::fstat(descriptor, &status) != 0) return system_failure(path, "read", errno);
    remember(path, stamp_of(status));
    if (S_ISFIFO(status.st_mode) && pipes == Pipes::refuse) {
        return std::unexpected(
            FileFailure({path, 0, 0, "is a pipe, which cannot be read again", "name a file"}));
    }
    if (S_ISDIR(status.st_mode)) {
        return std::unexpected(FileFailure({path, 0, 0, "is a folder, not a file", "name a file in it"}));
    }
    if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode)) {
        return std::unexpected(FileFailure({path, 0, 0, "is a device, not a file", "name a file"}));
    }
    const std::uint64_t told = S_ISREG(status.st_mode) ? static_cast<std::uint64_t>(status.st_size) : 0;
    if (told > limit_bytes) return too_long(path, limit_bytes);

    // Read one byte more than stated, to detect a file that is growing or whose length is unknown to the
    // system.
    std::string bytes;
    std::size_t filled = 0;
    for (std::uint64_t wanted = told + 1;; wanted = filled + kReadStepBytes) {
        bytes.resize(static_cast<std::size_t>(std::min(wanted, limit_bytes + 1)));
        if (const int error = read_some(descriptor, bytes, filled))
            return system_failure(path, "read", error);
        if (filled > limit_bytes) return too_long(path, limit_bytes);
        if (filled < bytes.size()) break;
    }
    bytes.resize(filled);
    if (S_ISREG(status.st_mode)) {
        const std::lock_guard lock(files_read().mutex);
        files_read().files.emplace(status.st_dev, status.st_ino);
    }
    return bytes;
}

FileResult<std::string> first_bytes(const std::string& path, std::size_t most) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return system_failure(path, "read", errno);
    const Closing closing{descriptor};
    std::string bytes(most, '\0');
    std::size_t filled = 0;
    if (const int error = read_some(descriptor, bytes, filled)) return system_failure(path, "read", error);
    bytes.resize(filled);
    return bytes;
}

bool was_read(const std::string& path) {
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0) return false;
    const std::lock_guard lock(files_read().mutex);
    return files_read().files.contains({status.st_dev, status.st_ino});
}

FileStamps stamps_of_files_read() {
    const std::lock_guard lock(files_read().mutex);
    return files_read().stamps;
}

bool have_changed(const FileStamps& stamps) {
    return std::ranges::any_of(stamps, [](const auto& named) {
        struct stat status = {};
        const bool there = ::stat(named.first.c_str(), &status) == 0;
        return (there ? stamp_of(status) : FileStamp{}) != named.second;
    });
}

FileWriter::FileWriter(std::string path, PendingFile file)
    : path_(std::move(path)), file_(std::make_unique<PendingFile>(std::move(file))) {
    buffer_.reserve(kWriteBufferBytes);
}

FileWriter::FileWriter(FileWriter&& other) noexcept = default;

FileWriter::~FileWriter() = default;

FileResult<FileWriter> FileWriter::create(const std::string& path) {
    FileResult<PendingFile> file = PendingFile::open(path);
    if (!file) return std::unexpected(std::move(file).error());
    return FileWriter(path, *std::move(file));
}

void FileWriter::flush(std::string_view bytes) {
    while (!bytes.empty() && error_number_ == 0) {
        const ssize_t written = ::write(file_->descriptor(), bytes.data(), bytes.size());
        if (written < 0) {
            if (errno != EINTR) error_number_ = errno;
        } else if (written == 0) {
            error_number_ = ENOSPC;
        } else {
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }
}

void FileWriter::write(std::string_view bytes) {
    if (buffer_.size() + bytes.size() > kWriteBufferBytes) {
        flush(buffer_);
        buffer_.clear();
        if (bytes.size() > kWriteBufferBytes) return flush(bytes);
    }
    buffer_.append(bytes);
}

FileResult<void> FileWriter::finish() {
    flush(buffer_);
    buffer_.clear();
    if (error_number_ == 0) error_number_ = file_->commit();
    file_.reset();
    if (error_number_ == 0) return {};
    return system_failure(path_, "write", error_number_);
}

FileResult<void> write_file(const std::string& path, std::string_view bytes) {
    FileResult<FileWriter> writer = FileWriter::create(path);
    if (!writer) return std::unexpected(std::move(writer).error());
    writer->write(bytes);
    return writer->finish();
}

}  // namespace tribo::files
