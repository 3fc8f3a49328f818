// SPDX-License-Identifier: MIT
#include "readers/vrml/shape/surface.hpp"

#include <algorithm>
#include <cmath>

#include "readers/vrml/shape/face_set.hpp"
#include "readers/vrml/shape/shapes.hpp"

namespace tribo::readers {

std::uint64_t count_triangles(const VrmlTree& tree, VrmlNodeId geometry) {
    switch (const VrmlRole role = tree.nodes[geometry].type->role) {
        case VrmlRole::face_set:
            return count_face_set_triangles(tree, geometry);
        case VrmlRole::grid:
            return count_grid_triangles(tree, geometry);
        case VrmlRole::extrusion:
            return count_extrusion_triangles(tree, geometry);
        default:
            return count_solid_triangles(role);
    }
}

Result<VrmlSurface> read_vrml_surface(VrmlTree& tree, VrmlNodeId geometry,
                                      PolygonTriangulator& triangulator) {
    switch (tree.nodes[geometry].type->role) {
        case VrmlRole::face_set:
            return read_vrml_face_set(tree, geometry, triangulator);
        case VrmlRole::grid:
            return read_vrml_grid(tree, geometry);
        case VrmlRole::extrusion:
            return read_vrml_extrusion(tree, geometry, triangulator);
        default:
            return read_vrml_solid(tree, geometry);
    }
}

std::vector<Rgb8> read_vrml_colours(const VrmlTree& tree, VrmlNodeId node, std::string_view field) {
    const VrmlValue* value = tree.find(node, field);
    const auto nodes = value ? tree.nodes_of(*value) : std::span<const VrmlNodeId>{};
    if (nodes.size() != 1) return {};
    const VrmlRole role = tree.nodes[nodes[0]].type->role;
    if (role != VrmlRole::colour && role != VrmlRole::material) return {};
    const VrmlValue* list = tree.find(nodes[0], role == VrmlRole::colour ? "color" : "diffuseColor");
    auto numbers = list ? tree.numbers_of(*list) : std::span<const double>{};
    if (role == VrmlRole::material) numbers = numbers.first(std::min<std::size_t>(numbers.size(), 3));
    std::vector<Rgb8> colours;
    colours.reserve(numbers.size() / 3);
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
        Rgb8 colour{};
        for (std::size_t k = 0; k < 3; ++k) {
            colour[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(numbers[i + k], 0.0, 1.0)));
        }
        colours.push_back(colour);
    }
    return colours;
}

}  // namespace tribo::readers
