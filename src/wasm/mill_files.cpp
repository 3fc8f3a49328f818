// SPDX-License-Identifier: MIT
#include "wasm/mill_files.hpp"

#include <map>

#include "base/file_names.hpp"
#include "files/files.hpp"

namespace tribo::wasm {
namespace {

std::map<std::string, std::string>& files() {
    static std::map<std::string, std::string> all;
    return all;
}

std::string_view last_name(std::string_view path) {
    return path.substr(path.rfind('/') + 1);
}

// By its whole name, or, as files are dropped without their folders, by the last part of it where only one
// file has that.
const std::string* find(const std::string& path) {
    const auto whole = files().find(path);
    if (whole != files().end()) return &whole->second;
    const std::string* found = nullptr;
    for (const auto& [name, bytes] : files()) {
        if (last_name(name) != last_name(path)) continue;
        if (found != nullptr) return nullptr;
        found = &bytes;
    }
    return found;
}

}  // namespace

void put_file(std::string name, std::string bytes) {
    files().insert_or_assign(std::move(name), std::move(bytes));
}

void forget_files() {
    files().clear();
}

Result<readers::Model> read_model(const readers::ModelFile& file) {
    const auto bytes = files::read_file(file.path);
    if (!bytes) return std::unexpected(Error(bytes.error()));
    readers::ModelOptions options;
    options.source_name = file.path;
    options.unit_mm = file.unit_mm;
    options.neighbours = [](std::string_view url, const std::string& from,
                            std::uint64_t limit_bytes) -> Result<readers::ModelNeighbour> {
        std::string name = file_beside(from, url);
        auto neighbour = files::read_file(name, limit_bytes);
        if (!neighbour) return std::unexpected(Error(neighbour.error()));
        return readers::ModelNeighbour{std::move(name), *std::move(neighbour)};
    };
    if (readers::detect_model_format(*bytes, file.path) == readers::ModelFormat::gltf) {
        return fail_at(file.path, 0, 0, "glTF models are not read in the page",
                       "save it as STL, OBJ, PLY or VRML, or use the program");
    }
    return readers::read_model(*bytes, options);
}

}  // namespace tribo::wasm

namespace tribo::files {

FileResult<std::string> read_file(const std::string& path, std::uint64_t limit_bytes) {
    const std::string* bytes = wasm::find(path);
    if (bytes == nullptr) {
        return std::unexpected(FileFailure({path, 0, 0, "the file is not here",
                                            "drop it into the window together with the file that names it"}));
    }
    if (bytes->size() > limit_bytes) {
        return std::unexpected(FileFailure({path, 0, 0, "the file is too large for what it is", {}}));
    }
    return *bytes;
}

}  // namespace tribo::files
