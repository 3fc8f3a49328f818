// SPDX-License-Identifier: MIT
#include "files/disk_source.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "base/text/file_names.hpp"
#include "files/json/stock_record_json.hpp"
#include "files/model/model_file.hpp"
#include "files/zip.hpp"

namespace tribo::files {
namespace {

namespace fs = std::filesystem;

fs::path resolved(const std::string& file) {
    std::error_code error;
    const fs::path absolute = fs::absolute(file, error);
    const fs::path folder = fs::weakly_canonical(absolute.parent_path(), error);
    return error ? fs::path(file) : folder / absolute.filename();
}

// Tool libraries of Fusion (.tools) are a zip with one file.
FileResult<std::string> unpacked(FileResult<std::string> bytes, const std::string& path,
                                 std::uint64_t limit_bytes) {
    if (!bytes || !is_zip(*bytes) || extension_of(path) != ".tools") return bytes;
    auto library = unzip(*bytes, ".json", limit_bytes, path);
    if (!library) return std::unexpected(FileFailure(library.error()));
    return *std::move(library);
}

}  // namespace

FileResult<std::string> DiskSource::read(const std::string& path, std::uint64_t limit_bytes) const {
    std::error_code error;
    if (policy_ == Pipes::refuse || !fs::is_fifo(path, error))
        return unpacked(read_file(path, limit_bytes, policy_), path, limit_bytes);
    const std::lock_guard lock(mutex_);
    const auto known = pipes_.find(path);
    if (known != pipes_.end()) return known->second;
    auto bytes = read_file(path, limit_bytes);
    if (bytes) pipes_.emplace(path, *bytes);
    return bytes;
}

FileResult<readers::Model> DiskSource::read_model(const readers::ModelFile& file) const {
    return read_model_file(file, policy_);
}

FileResult<job::StockSource> DiskSource::stock_source(const std::string& path) const {
    constexpr const char* kName = "name an earlier job (.toml) or the folder of its render";
    const auto refuse = [&](const std::string& cause, std::string remedy) {
        return std::unexpected(FileFailure({"", 0, 0, "'" + path + "' " + cause, std::move(remedy)}));
    };
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) return refuse("to take the stock from is not there", kName);
    if (!fs::is_directory(status)) {
        if (extension_of(path) == ".toml") return job::StockSource{path, {}, {}};
        return refuse("is no job (.toml) and no folder of a render",
                      std::string(kName) + "; a model of the stock is mesh = \"FILE\"");
    }
    auto record = read_stock_record(path);
    if (!record) {
        if (record.error().fault == FileFault::system) return std::unexpected(record.error());
        return refuse(record.error().cause, record.error().remedy);
    }
    const fs::path folder = fs::weakly_canonical(path, error);
    // Use the given name if it leads to the same file: messages show it.
    std::string file = (path / fs::path(record->job)).lexically_normal().string();
    const fs::path counted = (folder / record->job).lexically_normal();
    if (fs::exists(counted, error) && !fs::equivalent(file, counted, error)) file = counted.string();
    if (!fs::exists(file, error)) {
        return refuse("was rendered from '" + file + "', which is gone",
                      "bring it back, or begin with mesh = \"machined.stl\" of the folder");
    }
    return job::StockSource{file, *std::move(record), folder.string()};
}

std::string DiskSource::identity(const std::string& path) const {
    return resolved(path).string();
}

std::string relative_to(const std::string& folder, const std::string& file) {
    return resolved(file).lexically_proximate(folder).string();
}

}  // namespace tribo::files
