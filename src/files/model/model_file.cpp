// SPDX-License-Identifier: MIT
#include "files/model/model_file.hpp"

#include <filesystem>
#include <optional>

#include "files/gzip.hpp"
#include "files/model/gltf.hpp"

namespace tribo::files {
namespace {

namespace fs = std::filesystem;

// Text models may be compressed. More bytes than a reader accepts need not be unpacked.
constexpr std::uint64_t kLargestUnpacked = 64 * 1024 * 1024;

// Schemes (http:, file:, C:) lead out of the folder, whatever follows.
bool is_plain_name(const fs::path& url) {
    const std::string text = url.string();
    return !text.empty() && !url.is_absolute() && text.find_first_of(":\\") == std::string::npos &&
           text.find('\0') == std::string::npos;
}

bool is_below(const fs::path& file, const fs::path& folder) {
    auto f = file.begin();
    for (const fs::path& part : folder) {
        if (f == file.end() || *f++ != part) return false;
    }
    return true;
}

// The files that a model may name: files in its folder and below, with resolved links.
class Neighbours {
  public:
    explicit Neighbours(std::string model) : model_(std::move(model)) {
        std::error_code error;
        model_path_ = fs::canonical(model_, error);
    }

    Result<readers::ModelNeighbour> operator()(std::string_view url, const std::string& from,
                                               std::uint64_t limit_bytes) const {
        const fs::path name(url);
        if (!is_plain_name(name)) return fail("it is not a file in the model's folder");
        for (const fs::path& part : name) {
            if (part == "..") return fail("'..' may lead out of the model's folder");
        }
        std::error_code error;
        const fs::path path = fs::canonical(fs::path(from).parent_path() / name, error);
        if (error) return fail("there is no such file in the model's folder");
        if (model_path_.empty() || !is_below(path, model_path_.parent_path()))
            return fail("it lies outside of the model's folder");
        if (path == model_path_) return readers::ModelNeighbour{model_, {}};
        if (!fs::is_regular_file(path, error)) return fail("it is not a file");
        auto bytes = read_file(path.string(), limit_bytes, Pipes::refuse);
        if (!bytes) return fail(bytes.error().cause);
        if (is_gzip(*bytes)) {
            auto unpacked = gunzip(*bytes, limit_bytes, path.string());
            if (!unpacked) return fail(unpacked.error().cause);
            bytes = *std::move(unpacked);
        }
        // Named as the user would: the folder of the model and the relative path.
        const fs::path shown =
            fs::path(model_).parent_path() / path.lexically_relative(model_path_.parent_path());
        return readers::ModelNeighbour{shown.string(), *std::move(bytes)};
    }

  private:
    std::string model_;
    fs::path model_path_;
};

}  // namespace

FileResult<readers::Model> read_model_file(const readers::ModelFile& file, Pipes pipes) {
    FileResult<std::string> bytes = read_file(file.path, kLargestInputBytes, pipes);
    if (!bytes) return std::unexpected(bytes.error());
    if (is_gzip(*bytes)) {
        auto unpacked = gunzip(*bytes, kLargestUnpacked, file.path);
        if (!unpacked) return std::unexpected(FileFailure(unpacked.error()));
        bytes = *std::move(unpacked);
    }
    readers::ModelOptions options;
    options.source_name = file.path;
    options.unit_mm = file.unit_mm;
    options.max_triangles = file.max_triangles;
    options.neighbours = Neighbours(file.path);
    const auto format = readers::detect_model_format(*bytes, file.path);
    auto model = format == readers::ModelFormat::gltf ? read_gltf(*bytes, options)
                                                      : readers::read_model(*bytes, options);
    if (!model) return std::unexpected(FileFailure(model.error()));
    return *std::move(model);
}

}  // namespace tribo::files
