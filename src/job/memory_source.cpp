// SPDX-License-Identifier: MIT
#include "job/memory_source.hpp"

#include <string_view>
#include <utility>

#include "base/text/file_names.hpp"
#include "readers/tables/tool_table.hpp"

namespace tribo::job {
namespace {

std::string_view last_name(std::string_view path) {
    return path.substr(path.rfind('/') + 1);
}

std::unexpected<FileFailure> refuse(std::string file, std::string cause, std::string remedy) {
    return std::unexpected(FileFailure({std::move(file), 0, 0, std::move(cause), std::move(remedy)}));
}

}  // namespace

void MemorySource::put(std::string name, std::string bytes) {
    files_.insert_or_assign(std::move(name), std::move(bytes));
}

void MemorySource::clear() {
    files_.clear();
}

std::string MemorySource::tool_table() const {
    for (const auto& [name, bytes] : files_) {
        if (readers::is_tool_table(bytes, name)) return name;
    }
    return {};
}

// By its whole name. Files are dropped without their folders, so else by the last part of the name where only
// one file has that.
FileResult<std::string_view> MemorySource::find(const std::string& path) const {
    const auto whole = files_.find(path);
    if (whole != files_.end()) return whole->second;
    const std::string* found = nullptr;
    bool several = false;
    for (const auto& [name, bytes] : files_) {
        if (last_name(name) != last_name(path)) continue;
        several = found != nullptr;
        found = &bytes;
        if (several) break;
    }
    if (found != nullptr && !several) return *found;
    return refuse(path, "the file is not here",
                  "drop it into the window together with the file that names it");
}

FileResult<std::string> MemorySource::read(const std::string& path, std::uint64_t limit_bytes) const {
    const auto bytes = find(path);
    if (!bytes) return std::unexpected(bytes.error());
    if (bytes->size() > limit_bytes) {
        return refuse(
            path,
            "is longer than the " + std::to_string(limit_bytes) + " bytes that this kind of file may have",
            "check that it is the right one");
    }
    return std::string(*bytes);
}

FileResult<readers::Model> MemorySource::read_model(const readers::ModelFile& file) const {
    const auto bytes = find(file.path);
    if (!bytes) return std::unexpected(bytes.error());
    if (readers::detect_model_format(*bytes, file.path) == readers::ModelFormat::gltf) {
        return refuse(file.path, "glTF models are not read in the page",
                      "save it as STL, OBJ, PLY or VRML, or use the program");
    }
    readers::ModelOptions options;
    options.source_name = file.path;
    options.unit_mm = file.unit_mm;
    options.max_triangles = file.max_triangles;
    options.neighbours = [this](std::string_view url, const std::string& from,
                                std::uint64_t limit_bytes) -> Result<readers::ModelNeighbour> {
        std::string name = file_beside(from, url);
        auto neighbour = read(name, limit_bytes);
        if (!neighbour) return std::unexpected(Error(neighbour.error()));
        return readers::ModelNeighbour{std::move(name), *std::move(neighbour)};
    };
    auto model = readers::read_model(*bytes, options);
    if (!model) return std::unexpected(FileFailure(model.error()));
    return *std::move(model);
}

FileResult<StockSource> MemorySource::stock_source(const std::string& path) const {
    if (extension_of(path) == ".toml") return StockSource{path, {}, {}};
    return refuse("", "a page takes the stock from a job alone, not from '" + path + "'",
                  "name the earlier job (.toml) and drop it too, or use the program");
}

}  // namespace tribo::job
