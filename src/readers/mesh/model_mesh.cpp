// SPDX-License-Identifier: MIT
#include "readers/mesh/model_mesh.hpp"

#include <cmath>
#include <limits>

namespace tribo::readers {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

// Renumbers positions in the order of their first use by triangles. Drops the others.
void renumber(TriangleMesh& mesh) {
    std::vector<std::uint32_t> number(mesh.positions.size(), kUnused);
    std::vector<Point3f> used;
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& corner : t) {
            std::uint32_t& to = number[corner];
            if (to == kUnused) {
                to = static_cast<std::uint32_t>(used.size());
                used.push_back(mesh.positions[corner]);
            }
            corner = to;
        }
    }
    mesh.positions = std::move(used);
}

// Drops triangles that use a vertex twice. Returns their number.
std::size_t drop_degenerate(Model& model) {
    std::vector<Triangle>& triangles = model.mesh.triangles;
    std::vector<ModelPart>& parts = model.parts;
    const bool coloured = !model.colours.empty(), of_mill = !model.untouched.empty();
    std::size_t kept = 0;
    const auto keep_of = [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const Triangle t = triangles[i];
            if (is_degenerate(t)) continue;
            if (coloured) model.colours[kept] = model.colours[i];
            if (of_mill) model.untouched[kept] = model.untouched[i];
            triangles[kept++] = t;
        }
    };
    for (ModelPart& part : parts) {
        const std::size_t first = kept;
        keep_of(part.first_triangle, part.triangles);
        part.first_triangle = static_cast<std::uint32_t>(first);
        part.triangles = static_cast<std::uint32_t>(kept - first);
    }
    if (parts.empty()) keep_of(0, triangles.size());
    const std::size_t dropped = triangles.size() - kept;
    triangles.resize(kept);
    if (coloured) model.colours.resize(kept);
    if (of_mill) model.untouched.resize(kept);
    return dropped;
}

}  // namespace

std::optional<Point3f> to_position(double x, double y, double z, double unit_mm) {
    const Point3f p{static_cast<float>(x * unit_mm), static_cast<float>(y * unit_mm),
                    static_cast<float>(z * unit_mm)};
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) return std::nullopt;
    return p;
}

std::string too_many_triangles(const ModelOptions& options) {
    return "more than " + std::to_string(options.max_triangles) + " triangles";
}

std::string fewer_triangles(const ModelOptions& options) {
    return options.max_triangles < kMaxTriangles ? "simplify the model, or allow more memory"
                                                 : "simplify the model";
}

void warn_of_crossing_faces(Model& model, const ModelOptions& options, std::uint64_t faces) {
    if (faces == 0) return;
    model.warnings.push_back({options.source_name, 0,
                              faces == 1
                                  ? "a face crosses itself or has no area"
                                  : std::to_string(faces) + " faces cross themselves or have no area"});
}

Result<Model> finish_model(Model model, const ModelOptions& options, Weld weld) {
    if (weld == Weld::exact) weld_exactly(model.mesh);
    const std::size_t dropped = drop_degenerate(model);
    if (model.mesh.triangles.empty()) {
        return fail_at(options.source_name, 0, 0, "the model has no triangles",
                       "export it with its surface as a mesh");
    }
    if (dropped > 0) {
        model.warnings.push_back({options.source_name, 0,
                                  std::to_string(dropped) + " degenerate triangle" +
                                      (dropped == 1 ? " was" : "s were") + " dropped"});
    }
    renumber(model.mesh);
    return model;
}

}  // namespace tribo::readers
