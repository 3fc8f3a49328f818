// SPDX-License-Identifier: MIT
// ElevationGrid (ISO/IEC 14772-1, 6.17).
#include <cmath>
#include <utility>

#include "readers/vrml/fields.hpp"
#include "readers/vrml/shape/shapes.hpp"

namespace tribo::readers {
namespace {

// Number of points along x or z; 0 if the value is not a valid count.
std::uint64_t dimension(const VrmlTree& tree, VrmlNodeId grid, std::string_view field) {
    const VrmlValue* value = tree.find(grid, field);
    const auto numbers = value ? tree.numbers_of(*value) : std::span<const double>{};
    if (numbers.size() != 1 || !(numbers[0] >= 0 && numbers[0] <= 1e9) ||
        std::floor(numbers[0]) != numbers[0]) {
        return 0;
    }
    return static_cast<std::uint64_t>(numbers[0]);
}

// One colour for each square, or for each triangle the mean of its corners.
void add_colours(VrmlSurface& surface, const std::vector<Rgb8>& colours, bool per_vertex) {
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        if (!per_vertex) {
            surface.colours.push_back(colours[i / 2]);
            continue;
        }
        Rgb8 mean{};
        for (std::size_t k = 0; k < 3; ++k) {
            int sum = 1;
            for (const std::uint32_t corner : surface.triangles[i]) sum += colours[corner][k];
            mean[k] = static_cast<std::uint8_t>(sum / 3);
        }
        surface.colours.push_back(mean);
    }
}

}  // namespace

std::uint64_t count_grid_triangles(const VrmlTree& tree, VrmlNodeId grid) {
    const std::uint64_t x = dimension(tree, grid, "xDimension"), z = dimension(tree, grid, "zDimension");
    return x < 2 || z < 2 ? 0 : 2 * (x - 1) * (z - 1);
}

Result<VrmlSurface> read_vrml_grid(VrmlTree& tree, VrmlNodeId grid) {
    const VrmlFields fields(tree, grid);
    VrmlSurface surface;
    double dx = 1, dz = 1;
    bool ccw = true, per_vertex = true;
    if (auto ok = fields.read_size("xSpacing", dx, 0, false); !ok) return std::unexpected(ok.error());
    if (auto ok = fields.read_size("zSpacing", dz, 0, false); !ok) return std::unexpected(ok.error());
    for (const auto& [name, flag] : {std::pair{"ccw", &ccw}, std::pair{"solid", &surface.solid},
                                     std::pair{"colorPerVertex", &per_vertex}}) {
        if (auto ok = fields.read_flag(name, *flag); !ok) return std::unexpected(ok.error());
    }
    if (auto ok = fields.read_size("creaseAngle", surface.crease_angle_rad, 0, true); !ok)
        return std::unexpected(ok.error());
    const std::uint64_t x = dimension(tree, grid, "xDimension"), z = dimension(tree, grid, "zDimension");
    const auto heights = fields.read_list("height", 1);
    if (!heights) return std::unexpected(heights.error());
    if (heights->size() != x * z) {
        return fields.refuse_field("height", "ElevationGrid has " + std::to_string(heights->size()) +
                                                 " heights for " + std::to_string(x) + " times " +
                                                 std::to_string(z) + " points");
    }
    const auto nx = static_cast<std::uint32_t>(x), nz = static_cast<std::uint32_t>(z);
    for (std::uint32_t j = 0; j < nz; ++j) {
        for (std::uint32_t i = 0; i < nx; ++i) {
            surface.points.push_back({dx * i, (*heights)[std::size_t{nx} * j + i], dz * j});
        }
    }
    for (std::uint32_t j = 0; j + 1 < nz; ++j) {
        for (std::uint32_t i = 0; i + 1 < nx; ++i) {
            const std::uint32_t a = nx * j + i, b = a + 1, d = a + nx, c = d + 1;
            surface.triangles.push_back({a, ccw ? d : b, ccw ? b : d});
            surface.triangles.push_back({b, ccw ? d : c, ccw ? c : d});
        }
    }
    const std::vector<Rgb8> colours = read_vrml_colours(tree, grid, "color");
    const std::size_t wanted = per_vertex ? surface.points.size() : surface.triangles.size() / 2;
    if (!colours.empty() && colours.size() < wanted) {
        tree.warn_once(tree.nodes[grid].place,
                       "the colours of an ElevationGrid do not fit and were left out");
    } else if (!colours.empty()) {
        add_colours(surface, colours, per_vertex);
    }
    return surface;
}

}  // namespace tribo::readers
