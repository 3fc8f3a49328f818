// SPDX-License-Identifier: MIT
// What every model reader promises, whatever the bytes.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "readers/mesh/model.hpp"

namespace tribo::readers {

inline int check_model(const Result<Model>& model) {
    if (!model) {
        if (model.error().cause.empty() || model.error().remedy.empty()) std::abort();
        return 0;
    }
    const TriangleMesh& mesh = model->mesh;
    std::vector<bool> used(mesh.positions.size());
    for (const Triangle& t : mesh.triangles) {
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) std::abort();
        for (const std::uint32_t corner : t) used.at(corner) = true;
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
        const Point3f& p = mesh.positions[i];
        if (!used[i] || !std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) std::abort();
    }
    if (!model->colours.empty() && model->colours.size() != mesh.triangles.size()) std::abort();
    std::size_t in_parts = 0;
    for (const ModelPart& part : model->parts) in_parts += part.triangles;
    if (mesh.triangles.empty() || (!model->parts.empty() && in_parts != mesh.triangles.size())) std::abort();
    return 0;
}

inline int check_model(const std::uint8_t* data, std::size_t size, ModelFormat format) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    detect_model_format(bytes, "");
    return check_model(read_model(bytes, format, {.source_name = "fuzz"}));
}

}  // namespace tribo::readers
