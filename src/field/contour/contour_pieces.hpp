// SPDX-License-Identifier: MIT
// Which crossings of a cell of the grid one piece of the surface connects.
#pragma once

#include <array>

#include "field/contour/contour_nodes.hpp"

namespace tribo::field {

// Edges of a cell: 4 axis, + 1 where it lies at the upper end along axis + 1, + 2 along axis + 2.
inline constexpr int kCellEdges = 12;
// Crossings are counted as 2 edge + ordinal.
inline constexpr int kMostCrossings = 2 * kCellEdges;

struct CellPieces {
    std::array<const Crossing*, kMostCrossings> at{};  // null: there is none
    std::array<std::uint8_t, kMostCrossings> piece;    // of each crossing that there is
    int count = 0;
    bool simple = true;  // no edge is crossed twice

    bool has(std::size_t crossing, int of_piece) const { return at[crossing] && piece[crossing] == of_piece; }
    // Whether the surface comes back through the edge: a wall or slit ends in the cell.
    bool comes_back(std::size_t crossing) const {
        return at[crossing ^ 1] && piece[crossing ^ 1] == piece[crossing];
    }
    Vec3 middle(int of_piece) const;
    // Whether one of the planes across the normals at the crossings of two pieces, or across the way from one
    // vertex to the other, has all of one piece on one side, its vertex included, and all of the other on the
    // other, `gap_mm` apart.
    bool are_parted(int i, Vec3 vertex_i, int j, Vec3 vertex_j, double gap_mm) const;
};

// Of the cell whose lower corner is `node`.
CellPieces find_pieces(const BrickNodes& nodes, int node);

}  // namespace tribo::field
