// SPDX-License-Identifier: MIT
#include "field/contour/contour_pieces.hpp"

#include <algorithm>

namespace tribo::field {
namespace {

// Returns the number of an edge of the face of a cell with normal `axis` at its lower (0) or upper (1) side.
// `edge` is counted as in FaceSegment.
constexpr int face_edge(int axis, int side, int edge) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return edge == 0   ? 4 * u + 2 * side
           : edge == 1 ? 4 * v + side + 2
           : edge == 2 ? 4 * u + 1 + 2 * side
                       : 4 * v + side;
}

// Returns true if the surface is in one piece in a cell with these corners inside (bit a + 2 b + 4 c) and
// without an edge that is crossed twice. Material that meets across the diagonal of a face is not connected,
// air is.
constexpr bool is_one_piece(unsigned corners) {
    const auto pieces = [](unsigned set, bool diagonals) {
        int count = 0;
        while (set != 0) {
            ++count;
            unsigned piece = set & (~set + 1), before = 0;
            while (piece != before) {
                before = piece;
                for (unsigned n = 0; n < 8; ++n) {
                    if ((set >> n & 1) == 0) continue;
                    for (unsigned m = 0; m < 8; ++m) {
                        const unsigned way = n ^ m;
                        const bool edge = way == 1 || way == 2 || way == 4;
                        const bool diagonal = way == 3 || way == 5 || way == 6;
                        if ((piece >> m & 1) != 0 && (edge || (diagonal && diagonals))) piece |= 1U << n;
                    }
                }
            }
            set &= ~piece;
        }
        return count;
    };
    return pieces(corners, false) == 1 && pieces(~corners & 0xff, true) == 1;
}

constexpr std::array<bool, 256> kOnePiece = [] {
    std::array<bool, 256> table{};
    for (unsigned corners = 1; corners < 255; ++corners) table[corners] = is_one_piece(corners);
    return table;
}();

void connect(const BrickNodes& nodes, int n, CellPieces& p) {
    std::array<std::size_t, kMostCrossings> parent;
    for (std::size_t id = 0; id < kMostCrossings; ++id) parent[id] = id;
    const auto root = [&](std::size_t id) {
        while (parent[id] != id) id = parent[id];
        return id;
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            const FaceSegments f = nodes.segments(n + side * kStep[axis], axis);
            for (int k = 0; k < f.count; ++k) {
                const FaceSegment& s = f.all[static_cast<std::size_t>(k)];
                const auto id = [&](FaceSegment::End end) {
                    return root(static_cast<std::size_t>(2 * face_edge(axis, side, end.edge) + end.ordinal));
                };
                const std::size_t from = id(s.from), to = id(s.to);
                parent[std::max(from, to)] = std::min(from, to);
            }
        }
    }
    p.count = 0;
    for (std::size_t id = 0; id < kMostCrossings; ++id) {
        if (!p.at[id]) continue;
        p.piece[id] = root(id) == id ? static_cast<std::uint8_t>(p.count++) : p.piece[root(id)];
    }
}

}  // namespace

CellPieces find_pieces(const BrickNodes& nodes, int n) {
    CellPieces p;
    unsigned corners = 0;
    for (unsigned c = 0; c < 8; ++c) {
        const int node = n + (c & 1 ? kStep[0] : 0) + (c & 2 ? kStep[1] : 0) + (c & 4 ? kStep[2] : 0);
        corners |= nodes.inside(node) ? 1U << c : 0;
    }
    if ((corners == 0 || corners == 0xff) && !nodes.has_thin()) return p;
    for (int e = 0; e < kCellEdges; ++e) {
        const int axis = e / 4;
        const int node = n + (e & 1 ? kStep[(axis + 1) % 3] : 0) + (e & 2 ? kStep[(axis + 2) % 3] : 0);
        const EdgeCrossings x = nodes.crossings(axis, node);
        p.simple &= x.count < 2;
        for (int k = 0; k < x.count; ++k) {
            const auto id = static_cast<std::size_t>(2 * e + k);
            p.at[id] = &nodes.crossing(static_cast<std::size_t>(x.first + k));
            p.piece[id] = 0;
            p.count = 1;
        }
    }
    if (p.count > 0 && (!p.simple || !kOnePiece[corners])) connect(nodes, n, p);
    return p;
}

Vec3 CellPieces::middle(int of_piece) const {
    Vec3 sum;
    int crossings = 0;
    for (std::size_t id = 0; id < kMostCrossings; ++id) {
        if (!has(id, of_piece)) continue;
        sum += at[id]->point;
        ++crossings;
    }
    return sum / crossings;
}

bool CellPieces::are_parted(int i, Vec3 vertex_i, int j, Vec3 vertex_j, double gap_mm) const {
    const auto parts = [&](Vec3 across) {
        double most_i = dot(across, vertex_i), least_i = most_i;
        double most_j = dot(across, vertex_j), least_j = most_j;
        for (std::size_t id = 0; id < kMostCrossings; ++id) {
            if (!has(id, i) && !has(id, j)) continue;
            double& most = piece[id] == i ? most_i : most_j;
            double& least = piece[id] == i ? least_i : least_j;
            const double where = dot(across, at[id]->point);
            // Vertices on faces are a little away from an edge to which the surface comes back.
            const double off =
                comes_back(id) ? tribo::distance(at[id]->point, at[id ^ 1]->point) * length(across) : 0;
            most = std::max(most, where + off);
            least = std::min(least, where - off);
        }
        const double gap = gap_mm * length(across);
        return most_i + gap < least_j || most_j + gap < least_i;
    };
    if (parts(vertex_i - vertex_j)) return true;
    for (std::size_t id = 0; id < kMostCrossings; ++id) {
        if ((has(id, i) || has(id, j)) && parts(at[id]->normal)) return true;
    }
    return false;
}

}  // namespace tribo::field
