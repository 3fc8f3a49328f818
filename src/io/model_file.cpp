// SPDX-License-Identifier: MIT
#include "io/model_file.hpp"

#include "io/gltf.hpp"

namespace tribo::io {

FileResult<formats::Model> read_model_file(const formats::ModelFile& file) {
    const FileResult<std::string> bytes = read_file(file.path);
    if (!bytes) return std::unexpected(bytes.error());
    formats::ModelOptions options;
    options.source_name = file.path;
    options.unit_mm = file.unit_mm;
    const auto format = formats::detect_model_format(*bytes, file.path);
    auto model = format == formats::ModelFormat::gltf ? read_gltf(*bytes, options)
                                                      : formats::read_model(*bytes, options);
    if (!model) return std::unexpected(Failure(model.error()));
    return *std::move(model);
}

}  // namespace tribo::io
