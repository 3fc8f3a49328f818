// SPDX-License-Identifier: MIT
// Finds which crossings of a cell of the grid are connected by one piece of the surface.
#pragma once

#include <array>

#include "field/contour/contour_nodes.hpp"

namespace tribo::field {

// Edges of a cell: 4 axis, + 1 where it lies at the upper end along axis + 1, + 2 along axis + 2.
inline constexpr int kCellEdges = 12;
// Crossings are counted as 2 edge + ordinal.
inline constexpr int kMostCrossings = 2 * kCellEdges;

struct CellPieces {
    std::array<const Crossing*, kMostCrossings> at{};  // null: there is no such crossing
    std::array<std::uint8_t, kMostCrossings> piece;    // of each existing crossing
    int count = 0;
    bool simple = true;  // no edge is crossed twice

    bool has(std::size_t crossing, int of_piece) const { return at[crossing] && piece[crossing] == of_piece; }
    // Returns true if the surface comes back through the edge: a wall or slit ends in the cell.
    bool comes_back(std::size_t crossing) const {
        return at[crossing ^ 1] && piece[crossing ^ 1] == piece[crossing];
    }
    Vec3 middle(int of_piece) const;
    // Returns true if a plane separates two pieces, each with its vertex, `gap_mm` apart. The tested planes
    // are those across the normals at the crossings of both pieces and the one across the line from one
    // vertex to the other.
    bool are_parted(int i, Vec3 vertex_i, int j, Vec3 vertex_j, double gap_mm) const;
};

// Finds the pieces of the cell with the lower corner `node`.
CellPieces find_pieces(const BrickNodes& nodes, int node);

}  // namespace tribo::field
