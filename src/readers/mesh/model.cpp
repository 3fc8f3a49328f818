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

// Formats that are common and not read, by the ending of the file.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kOthers{{{".3mf", "3MF"},
                                                                                 {".step", "STEP"},
                                                                                 {".stp", "STEP"},
                                                                                 {".iges", "IGES"},
                                                                                 {".igs", "IGES"},
                                                                                 {".amf", "AMF"},
                                                                                 {".dae", "COLLADA"},
                                                                                 {".fbx", "FBX"},
                                                                                 {".x3d", "X3D"},
                                                                                 {".sat", "ACIS"}}};

std::string_view ending_of(std::string_view file) {
    const std::size_t dot = file.rfind('.');
    return dot == std::string_view::npos ? std::string_view() : file.substr(dot);
}

}  // namespace

std::optional<ModelFormat> model_format_of_name(std::string_view file) {
    constexpr std::array<std::pair<std::string_view, ModelFormat>, 7> extensions{{
        {".stl", ModelFormat::stl},
        {".obj", ModelFormat::obj},
        {".ply", ModelFormat::ply},
        {".wrl", ModelFormat::vrml},
        {".vrml", ModelFormat::vrml},
        {".glb", ModelFormat::gltf},
        {".gltf", ModelFormat::gltf},
    }};
    for (const auto& [extension, format] : extensions) {
        if (equals_ignoring_case(ending_of(file), extension)) return format;
    }
    return std::nullopt;
}

std::string_view other_model_format(std::string_view file) {
    for (const auto& [extension, format] : kOthers) {
        if (equals_ignoring_case(ending_of(file), extension)) return format;
    }
    return {};
}

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
    if (const auto by_name = model_format_of_name(source_name)) return by_name;
    if (looks_like_obj(bytes)) return ModelFormat::obj;
    return std::nullopt;
}

Result<Model> read_model(std::string_view bytes, const ModelOptions& options) {
    if (bytes.empty())
        return fail_at(options.source_name, 0, 0, "the file is empty", "export the model again");
    const auto format = detect_model_format(bytes, options.source_name);
    if (!format) {
        const std::string other(other_model_format(options.source_name));
        return fail_at(options.source_name, 0, 0,
                       other.empty() ? "not a model format that is known" : other + " models are not read",
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
