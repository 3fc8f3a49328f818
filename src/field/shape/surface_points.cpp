// SPDX-License-Identifier: MIT
#include "field/shape/surface_points.hpp"

#include <array>
#include <cmath>

namespace tribo::field {
namespace {

constexpr double kNearCells = 0.5;
constexpr double kOnSurface = 1e-6;  // mm
constexpr int kMostSteps = 6;

// Calls take(node) for each node of a brick that represents a piece of the surface. Nodes on the upper faces
// belong to the neighbours.
template <class Take>
void for_nodes(const CarvedField& field, BrickCoord coord, const Take& take) {
    const BrickRef ref = field.ref(coord);
    if (ref == kAir) return;
    if (ref == kUntouched &&
        std::abs(field.blank().distance_mm(field.centre(coord))) > field.brick_radius_mm())
        return;
    std::array<float, kLatticeNodes> distance_mm;
    field.sample_nodes(coord, distance_mm.data());
    const auto near_mm = static_cast<float>(kNearCells * field.cell_mm());
    const Lattice lattice = field.lattice(coord);
    for (int c = 0; c < kBrickCells; ++c) {
        for (int b = 0; b < kBrickCells; ++b) {
            for (int a = 0; a < kBrickCells; ++a) {
                if (std::abs(distance_mm[static_cast<std::size_t>(node_index(a, b, c))]) <= near_mm)
                    take(lattice.node(a, b, c));
            }
        }
    }
}

}  // namespace

std::optional<Vec3> onto_surface(const contact::DistanceField& field, Vec3 p) {
    for (int n = 0; n < kMostSteps; ++n) {
        const contact::SurfaceSample s = field.sample(p);
        if (std::abs(s.distance_mm) <= kOnSurface)
            return contact::has_material_behind(field, p, s.normal) ? std::optional(p) : std::nullopt;
        p -= s.distance_mm * s.normal;
    }
    return std::nullopt;
}

std::vector<Vec3> surface_points(const CarvedField& field, std::size_t most, const ParallelFor& parallel) {
    // Bricks of one height are processed together.
    const BrickCoord size = field.size();
    const auto for_layer = [&](std::size_t k, const auto& take) {
        for (int j = 0; j < size.j; ++j) {
            for (int i = 0; i < size.i; ++i) for_nodes(field, {i, j, static_cast<int>(k)}, take);
        }
    };
    const auto layers = static_cast<std::size_t>(size.k);
    std::vector<std::size_t> counts(layers);
    parallel(layers, [&](std::size_t k) { for_layer(k, [&](Vec3) { ++counts[k]; }); });
    std::size_t total = 0;
    std::vector<std::size_t> before(layers);
    for (std::size_t k = 0; k < layers; ++k) {
        before[k] = total;
        total += counts[k];
    }
    const std::size_t every = total / std::max<std::size_t>(most, 1) + 1;
    std::vector<std::vector<Vec3>> found(layers);
    parallel(layers, [&](std::size_t k) {
        std::size_t n = before[k];
        for_layer(k, [&](Vec3 node) {
            if (n++ % every != 0) return;
            if (const auto p = onto_surface(field, node)) found[k].push_back(*p);
        });
    });
    std::vector<Vec3> points;
    for (const std::vector<Vec3>& layer : found) points.insert(points.end(), layer.begin(), layer.end());
    return points;
}

}  // namespace tribo::field
