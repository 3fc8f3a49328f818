// SPDX-License-Identifier: MIT
// A brick: eight nodes (seven cells) along each edge of the field's grid, with the shapes that make its
// surface. Neighbours share the nodes of their common face, so that a brick alone answers everything inside
// it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/rare.hpp"
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

// Distance at a node in steps of a 16,384th of a cell, below 0 in material. It stands for the middle of its
// step: the sign is exact, the error is at most half a step. It reaches two cells: beyond, its size is a
// lower bound.
using NodeSteps = std::int16_t;
inline constexpr float kStepsPerCell = 16384;
constexpr float cells_of(NodeSteps steps) {
    return (static_cast<float>(steps) + 0.5f) * (1 / kStepsPerCell);
}

// For each node of a brick the index of a shape in the list of the brick, or kUnlisted. An index takes one
// byte; in the rare list of more than 255 shapes it takes two.
class Winners {
  public:
    static constexpr std::uint16_t kUnlisted = 0xffff;
    using Bytes = std::array<std::uint8_t, kLatticeNodes>;

    std::uint16_t operator[](std::size_t node) const {
        if (high_) return static_cast<std::uint16_t>(low_[node] | (*high_)[node] << 8);
        return low_[node] == kUnlistedByte ? kUnlisted : low_[node];
    }
    void fill(std::uint16_t index);  // below 255, or kUnlisted
    // Makes room for the indices of a list of `count` shapes.
    void make_room(std::size_t count);
    // Replaces each index n by to[n]; all of these are kUnlisted or below `count`. kUnlisted stays.
    void rename(std::span<const std::uint16_t> to, std::size_t count);

    std::uint8_t* low() { return low_.data(); }
    std::uint8_t* high() { return high_ ? high_->data() : nullptr; }  // null: no index has a second byte
    std::size_t bytes_beside() const { return high_ ? sizeof(Bytes) : 0; }
    bool operator==(const Winners& other) const;

  private:
    static constexpr std::uint8_t kUnlistedByte = 0xff;
    Bytes low_;
    Rare<Bytes> high_;
};

struct Brick {
    static constexpr std::uint16_t kUnlisted = Winners::kUnlisted;
    // Nodes within this many cells of the surface decide the list of shapes.
    static constexpr float kNearCells = 1.8f;

    BrickCoord coord;
    Version version = 0;       // of the field when the brick was made
    std::uint64_t change = 0;  // number of the last carve that changed it
    double volume_mm3 = 0;     // of the material in it
    std::array<NodeSteps, kLatticeNodes> steps;
    // The shape of `shapes` that gives the distance. At nodes that are not near the surface it may be
    // kUnlisted.
    Winners winner;
    std::vector<ShapeId> shapes;  // shapes that give the distance at some node near the surface
    // Nodes in a wall that is thinner than a cell, in order. The distance knows only one side of the wall.
    // `missing_cells` is the volume around the node that it counts too much.
    struct Thin {
        std::uint16_t node;
        float missing_cells;  // 0..1
    };
    std::vector<Thin> thin;

    // Distance at a node in cells.
    float cells(int node) const { return cells_of(steps[static_cast<std::size_t>(node)]); }
};

constexpr int node_index(int a, int b, int c) {
    return a + kLatticeEdge * (b + kLatticeEdge * c);
}

// Result of carving one shape from one brick.
struct CarveResult {
    bool changed = false;   // some node near the surface moved
    bool won = false;       // the shape gives the distance at some node near the surface
    bool tied = false;      // at some node near the surface it is as far as the shape that keeps the node
    float least_cells = 0;  // smallest distance left
    double removed_cells = 0;
};

// The change that one carve makes to walls that are thinner than a cell; see ThinWalls::find.
class ThinWalls {
  public:
    // Examines a brick before `shape_mm` (distances at its nodes) is carved from it.
    void find(const Brick& brick, const float* shape_mm, float cell_mm);
    // Call this after the carve. Stores in the brick the missing volume of its thin nodes. Returns the
    // removed volume (in cells) that its distances do not show.
    double update(Brick& brick) const;

  private:
    struct Node {
        std::uint16_t node;
        float filled, missing;  // cells: content after the carve; missing volume before it
    };
    std::vector<Node> nodes_;
};

// Removes the shapes that give the distance at no node near the surface. The newest shape, with distances
// `newest_mm` at the nodes, takes the place of each shape whose nodes it all gives too, within `tie_mm`: a
// layer below takes over the walls of the layers above it.
void prune_shapes(Brick& brick, const float* newest_mm, float cell_mm, float tie_mm);

}  // namespace tribo::field
