// SPDX-License-Identifier: MIT
// The nodes of one brick and the crossings of the surface with the edges between them. All bricks that share
// a node agree on its value.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "field/carved/carved_field.hpp"
#include "field/contour/contour_corner.hpp"

namespace tribo::field {

// Step of the node index along x, y, z: from a node to the other end of the edge that it owns.
inline constexpr int kStep[3] = {1, kLatticeEdge, kLatticeEdge* kLatticeEdge};

inline Vec3 node_mm(const Lattice& lattice, int node) {
    return lattice.node(node % kLatticeEdge, node / kLatticeEdge % kLatticeEdge,
                        node / (kLatticeEdge * kLatticeEdge));
}

// A point where the surface crosses an edge of the grid.
struct Crossing : FacePoint {
    std::uint16_t edge = 0;  // lattice nodes x axis + lower node
    double along = 0;        // from the lower node of the edge, in cells
};

// The crossings of one edge, as a part of a list. An edge with both ends on the same side has two crossings
// if a wall or slot that is thinner than a cell passes between them.
struct EdgeCrossings {
    std::uint16_t first = 0;
    std::uint16_t count = 0;
};

// One segment of the curve in which the surface meets a face between two cells. It connects two edges of the
// face; `ordinal` is the number of the crossing on each edge. Edges are counted around the face, whose normal
// is axis n: 0 along n + 1 from the lower corner, 1 along n + 2, 2 and 3 opposite to these.
struct FaceSegment {
    struct End {
        std::uint8_t edge, ordinal;
    };
    End from, to;
};
struct FaceSegments {
    std::array<FaceSegment, 4> all;
    int count = 0;
    bool has_thin = false;  // an edge of the face has two crossings
};

class BrickNodes {
  public:
    BrickNodes(const CarvedField& field, BrickCoord coord);

    bool inside(int node) const { return value_[static_cast<std::size_t>(node)] < 0; }
    // Returns the cells of a row along x whose corners lie on both sides of the surface: bit a for the cell
    // at (a, b, c).
    unsigned mixed_cells(int b, int c) const {
        const auto row = static_cast<std::size_t>(b + kLatticeEdge * c);
        const unsigned r0 = inside_[row], r1 = inside_[row + 1], r2 = inside_[row + kLatticeEdge],
                       r3 = inside_[row + kLatticeEdge + 1];
        const unsigned any = r0 | r1 | r2 | r3, all = r0 & r1 & r2 & r3;
        return (any | any >> 1) & ~(all & all >> 1) & ((1U << kBrickCells) - 1);
    }
    // Returns true if the brick or its border may contain a part of the surface.
    bool has_surface() const;

    // Finds all crossings of the edges of this brick, its border included, sorted by edge. A pure function of
    // the field: bricks that share an edge find the same crossings. Call it once, before the functions below.
    // `rough`: as in ContourOptions.
    void find_crossings(bool rough);
    EdgeCrossings crossings(int axis, int node) const {
        return edges_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(node)];
    }
    const Crossing& crossing(std::size_t n) const { return list_[n]; }
    const std::vector<Crossing>& list() const { return list_; }
    // Returns true if an edge is crossed twice.
    bool has_thin() const { return has_thin_; }

    // Returns how the crossings of the face with the lower corner `node` and the normal `axis` are connected.
    FaceSegments segments(int node, int axis) const;
    // Returns the crossing at the end of a segment of that face.
    const Crossing& at(int node, int axis, FaceSegment::End end) const;

    Vec3 node_mm(int node) const { return field::node_mm(lattice_, node); }
    BrickRef ref() const { return ref_; }

  private:
    BrickRef around(int di, int dj, int dk) const {
        return around_[static_cast<std::size_t>((di + 1) + 3 * ((dj + 1) + 3 * (dk + 1)))];
    }
    void find_around();
    void agree_on_border();
    void look_at_rows();
    void look_at_edge(int axis, int node, bool rough);
    BrickRef ref_between(int from, int to) const;
    Crossing find_crossing(BrickRef ref, int axis, int node, double t0, double t1, double d0,
                           double d1) const;
    Crossing rough_crossing(int axis, int node, double d0, double d1) const;
    Crossing crossing_at(int axis, int node, double along) const;
    std::optional<Crossing> crossing_of(ShapeId shape, int axis, int node) const;
    Vec3 rough_normal(int node) const;
    ShapeId shape_at(BrickRef ref, int node) const;
    void find_thin(int axis, int node);
    bool is_parted(BrickRef ref, Vec3 p, Vec3 q, bool by_material) const;
    bool is_joined(int node, int axis, const std::array<FaceSegment::End, 8>& ends, int count) const;

    const CarvedField& field_;
    BrickCoord coord_;
    Lattice lattice_;
    BrickRef ref_;
    bool untouched_around_ = true, has_thin_ = false;
    std::array<BrickRef, 27> around_;
    std::array<float, kLatticeNodes> value_;
    // For each row of nodes along x, bit a for the node at a: inside; less than a cell from the surface; less
    // than half a cell from it.
    static constexpr std::size_t kRows = kLatticeEdge * kLatticeEdge;
    std::array<std::uint8_t, kRows> inside_, near_, very_near_;
    std::array<std::array<EdgeCrossings, kLatticeNodes>, 3> edges_;
    std::vector<Crossing> list_;
};

}  // namespace tribo::field
