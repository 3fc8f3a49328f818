// SPDX-License-Identifier: MIT
#include "readers/mesh/model.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "readers/mesh/obj.hpp"
#include "readers/mesh/ply.hpp"
#include "readers/mesh/stl.hpp"
#include "readers/text/model_text.hpp"
#include "readers/vrml/vrml.hpp"

namespace tribo::readers {
namespace {

std::optional<ModelFormat> format_of_extension(std::string_view file) {
    constexpr std::array<std::pair<std::string_view, ModelFormat>, 7> extensions{{
        {".stl", ModelFormat::stl},
        {".obj", ModelFormat::obj},
        {".ply", ModelFormat::ply},
        {".wrl", ModelFormat::vrml},
        {".vrml", ModelFormat::vrml},
        {".glb", ModelFormat::gltf},
        {".gltf", ModelFormat::gltf},
    }};
    const std::size_t dot = file.rfind('.');
    if (dot == std::string_view::npos) return std::nullopt;
    for (const auto& [extension, format] : extensions) {
        if (equals_ignoring_case(file.substr(dot), extension)) return format;
    }
    return std::nullopt;
}

}  // namespace

std::string_view name(ModelFormat format) {
    switch (format) {
        case ModelFormat::stl:
            return "STL";
        case ModelFormat::obj:
            return "OBJ";
        case ModelFormat::ply:
            return "PLY";
        case ModelFormat::vrml:
            return "VRML";
        case ModelFormat::gltf:
            return "glTF";
    }
    return {};
}

std::optional<ModelFormat> detect_model_format(std::string_view bytes, std::string_view source_name) {
    if (bytes.starts_with("glTF")) return ModelFormat::gltf;
    if (looks_like_vrml(bytes)) return ModelFormat::vrml;
    if (looks_like_ply(bytes)) return ModelFormat::ply;
    if (looks_like_stl(bytes)) return ModelFormat::stl;
    if (const auto by_name = format_of_extension(source_name)) return by_name;
    if (looks_like_obj(bytes)) return ModelFormat::obj;
    return std::nullopt;
}

Result<Model> read_model(std::string_view bytes, const ModelOptions& options) {
    if (bytes.empty())
        return fail_at(options.source_name, 0, 0, "the file is empty", "export the model again");
    const auto format = detect_model_format(bytes, options.source_name);
    if (!format) {
        return fail_at(options.source_name, 0, 0, "not a model format that is known",
                       "export the model as STL, OBJ, PLY, VRML 2.0 or glTF");
    }
    return read_model(bytes, *format, options);
}

Result<Model> read_model(std::string_view bytes, ModelFormat format, const ModelOptions& options) {
    if (!(std::isfinite(options.unit()) && options.unit() > 0)) {
        return fail_at(options.source_name, 0, 0, "the unit must be a length above 0 mm",
                       "set unit_mm to it");
    }
    switch (format) {
        case ModelFormat::stl:
            return read_stl(bytes, options);
        case ModelFormat::obj:
            return read_obj(bytes, options);
        case ModelFormat::ply:
            return read_ply(bytes, options);
        case ModelFormat::vrml:
            return read_vrml(bytes, options);
        case ModelFormat::gltf:
            break;
    }
    return fail_at(options.source_name, 0, 0, "glTF cannot be read from bytes alone", "read it as a file");
}

}  // namespace tribo::readers
