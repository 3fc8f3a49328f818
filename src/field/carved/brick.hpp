// SPDX-License-Identifier: MIT
// A brick: eight nodes (seven cells) along each edge of the field's grid, with the shapes that make its
// surface. Neighbours share the nodes of their common face, so that a brick alone answers everything inside
// it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "field/shape/shape.hpp"

namespace tribo::field {

inline constexpr int kBrickCells = kLatticeEdge - 1;

// Integer coordinates of a brick: its first node is node kBrickCells * (i, j, k) of the grid.
struct BrickCoord {
    int i = 0, j = 0, k = 0;
    constexpr bool operator==(const BrickCoord&) const = default;
};

// Number of a state of a field that was shown to a reader (field_reader.hpp); 0: never shown.
using Version = std::uint64_t;

// Index of a shape in its field: 0 is the blank, all others are carved away.
using ShapeId = std::uint32_t;

struct Brick {
    static constexpr std::uint16_t kUnlisted = 0xffff;

    BrickCoord coord;
    Version version = 0;                           // of the field when the brick was made
    std::uint64_t change = 0;                      // number of the last carve that changed it
    double volume_mm3 = 0;                         // of the material in it
    std::array<float, kLatticeNodes> distance_mm;  // at the nodes, negative in material, at least -near
    // Index into `shapes` of the shape that gives the distance, if the distance is within near of the
    // surface. Otherwise it may be kUnlisted.
    std::array<std::uint16_t, kLatticeNodes> winner;
    std::vector<ShapeId> shapes;  // shapes that give the distance at some node near the surface
    // Nodes in a wall that is thinner than a cell, in order. The distance knows only one side of the wall.
    // `missing_cells` is the volume around the node that it counts too much.
    struct Thin {
        std::uint16_t node;
        float missing_cells;  // 0..1
    };
    std::vector<Thin> thin;
};

constexpr int node_index(int a, int b, int c) {
    return a + kLatticeEdge * (b + kLatticeEdge * c);
}

// Result of carving one shape from one brick.
struct CarveResult {
    bool changed = false;  // some node near the surface moved
    bool won = false;      // the shape gives the distance at some node near the surface
    bool tied = false;     // at some node near the surface it is as far as the shape that keeps the node
    float least_mm = 0;    // smallest distance left
    double removed_cells = 0;
};

// The change that one carve makes to walls that are thinner than a cell; see ThinWalls::find.
class ThinWalls {
  public:
    // Examines a brick before `shape_mm` (distances at its nodes) is carved from it.
    void find(const Brick& brick, const float* shape_mm, float cell_mm);
    // Call this after the carve. Stores in the brick the missing volume of its thin nodes. Returns the
    // removed volume (in cells) that its distances do not show.
    double update(Brick& brick, float cell_mm) const;

  private:
    struct Node {
        std::uint16_t node;
        float filled, missing;  // cells: content after the carve; missing volume before it
    };
    std::vector<Node> nodes_;
};

// Removes the shapes that give the distance at no node within `near_mm` of the surface. The newest shape,
// with distances `newest_mm` at the nodes, takes the place of each shape whose nodes it all gives too, within
// `tie_mm`: a layer below takes over the walls of the layers above it.
void prune_shapes(Brick& brick, const float* newest_mm, float near_mm, float tie_mm);

}  // namespace tribo::field
