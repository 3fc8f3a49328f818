// SPDX-License-Identifier: MIT
// A brick: eight nodes (seven cells) along each edge of the field's grid, with the shapes that make its
// surface. Neighbours share the nodes of their common face, so everything inside a brick is answered by that
// brick alone.
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

// Counts the states of a field that were shown to a reader (field_reader.hpp); 0: to none.
using Version = std::uint64_t;

// Index of a shape in its field: 0 is the blank, all others are carved away.
using ShapeId = std::uint32_t;

struct Brick {
    static constexpr std::uint16_t kUnlisted = 0xffff;

    BrickCoord coord;
    Version version = 0;                           // of the field when it was made
    double volume_mm3 = 0;                         // of the material in it
    std::array<float, kLatticeNodes> distance_mm;  // at the nodes, negative in material, at least -near
    // Index into `shapes` of the shape that gives the distance, where that is within near of the surface;
    // else it may be kUnlisted.
    std::array<std::uint16_t, kLatticeNodes> winner;
    std::vector<ShapeId> shapes;  // those that give the distance at some node near the surface
    // Nodes in a wall that is thinner than a cell, in order: how much less material is around them than the
    // distance, which knows of one side of the wall, says.
    struct Thin {
        std::uint16_t node;
        float missing_cells;  // 0..1
    };
    std::vector<Thin> thin;
};

constexpr int node_index(int a, int b, int c) {
    return a + kLatticeEdge * (b + kLatticeEdge * c);
}

// What the update of one brick by one carved shape needs to know about it.
struct CarveResult {
    bool changed = false;  // some node near the surface moved
    bool won = false;      // the shape gives the distance at some node near the surface
    float least_mm = 0;    // smallest distance left
    double removed_cells = 0;
};

// What one carve changes about walls that are thinner than a cell; see ThinWalls::find.
class ThinWalls {
  public:
    // Looks at a brick before `shape_mm` (at its nodes) is taken out of it.
    void find(const Brick& brick, const float* shape_mm, float cell_mm);
    // Once it is: notes in the brick what its thin nodes miss now, and gives how much more of it (in cells)
    // was removed than its distances say.
    double update(Brick& brick, float cell_mm) const;

  private:
    struct Node {
        std::uint16_t node;
        float filled, missing;  // cells: what is there after the carve; what was missing before it
    };
    std::vector<Node> nodes_;
};

// Forgets the shapes that give the distance at no node within `near_mm` of the surface.
void prune_shapes(Brick& brick, float near_mm);

}  // namespace tribo::field
