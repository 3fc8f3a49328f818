// SPDX-License-Identifier: MIT
#include "app/sweep/case_store.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <unistd.h>

#include "files/json/json.hpp"

namespace tribo::app {
namespace {

constexpr const char* kEnding = ".cases";

// Writes all bytes. Returns 0 or the error number.
int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

// Calls `use` with each line that has its end. Returns where the last of them ends.
template <class Use>
std::uint64_t whole_lines(std::istream& in, const Use& use) {
    std::string line;
    std::uint64_t offset = 0;
    while (std::getline(in, line) && !in.eof()) {
        use(line, offset);
        offset += line.size() + 1;
    }
    return offset;
}

}  // namespace

std::string line_of(const CaseResult& result) {
    files::Json json;
    json["id"] = result.id;
    if (!result.error.empty()) {
        json["error"] = result.error;
        if (result.died) json["died"] = true;
    } else {
        files::Json& values = json["values"] = files::Json::object();
        for (const auto& [name, value] : result.values) files::set(values, name.c_str(), value);
    }
    return files::dump(json) + "\n";
}

std::optional<CaseResult> read_case(std::string_view line) {
    const files::Json json = files::parse(line);
    if (!json.is_object() || !json.contains("id") || !json["id"].is_string()) return std::nullopt;
    CaseResult result;
    result.id = json["id"].get<std::string>();
    if (json.contains("error") && json["error"].is_string()) {
        result.error = json["error"].get<std::string>();
        result.died = json.contains("died");
        return result;
    }
    if (!json.contains("values") || !json["values"].is_object()) return std::nullopt;
    for (const auto& [name, value] : json["values"].items()) {
        if (!value.is_number()) return std::nullopt;
        result.values.emplace_back(name, value.get<double>());
    }
    return result;
}

FileResult<void> scan_cases(const std::string& dir, std::vector<std::string>& names,
                            const std::function<void(const CaseResult&, CasePlace)>& use) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(dir, error)) {
        if (entry.path().extension() == kEnding) names.push_back(entry.path().string());
    }
    if (error && error != std::errc::no_such_file_or_directory)
        return files::system_failure(dir, "read", error.value());
    std::ranges::sort(names);
    for (std::uint32_t n = 0; n < names.size(); ++n) {
        std::ifstream in(names[n], std::ios::binary);
        if (!in) return files::system_failure(names[n], "read", errno);
        whole_lines(in, [&](const std::string& line, std::uint64_t offset) {
            if (const auto result = read_case(line)) use(*result, {n, offset});
        });
    }
    return {};
}

std::string own_case_file(const std::string& digest, const std::string& what) {
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) host = {"host"};
    return digest.substr(0, 8) + "-" + host.data() + "-" + std::to_string(::getpid()) + "-" + what + kEnding;
}

FileResult<std::vector<CaseId>> ids_in(const std::string& path) {
    std::vector<CaseId> ids;
    std::ifstream in(path, std::ios::binary);
    if (!in && errno != ENOENT) return files::system_failure(path, "read", errno);
    whole_lines(in, [&](const std::string& line, std::uint64_t) {
        if (const auto result = read_case(line)) ids.push_back(result->id);
    });
    return ids;
}

FileResult<CaseFile> CaseFile::open(const std::string& path) {
    CaseFile file;
    file.path_ = path;
    file.descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file.descriptor_ < 0) return files::system_failure(path, "write", errno);
    std::ifstream in(path, std::ios::binary);
    const std::uint64_t end = whole_lines(in, [&](const std::string& line, std::uint64_t) {
        if (const auto result = read_case(line)) file.ids_.push_back(result->id);
    });
    if (::ftruncate(file.descriptor_, static_cast<off_t>(end)) != 0)
        return files::system_failure(path, "write", errno);
    return file;
}

CaseFile::CaseFile(CaseFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      ids_(std::move(other.ids_)) {}

CaseFile::~CaseFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

FileResult<void> CaseFile::add(const CaseResult& result) {
    if (const int error = write_all(descriptor_, line_of(result)))
        return files::system_failure(path_, "write", error);
    return {};
}

FileResult<void> CaseFile::sync() {
    if (::fsync(descriptor_) != 0) return files::system_failure(path_, "write", errno);
    return {};
}

}  // namespace tribo::app
