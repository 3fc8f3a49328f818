// SPDX-License-Identifier: MIT
// The vertices of a contour that belong to one brick: one for each piece of the surface in a cell, and one on
// a face between cells where the surface would otherwise not pass through that face correctly.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/mesh.hpp"
#include "field/contour/contour.hpp"
#include "field/contour/contour_pieces.hpp"

namespace tribo::field {

inline constexpr int kCells = kBrickCells * kBrickCells * kBrickCells;

constexpr int cell_index(int a, int b, int c) {
    return a + kBrickCells * (b + kBrickCells * c);
}

// The data of a crossing that the polygon around it needs.
struct EdgePoint {
    std::uint16_t edge;    // lattice nodes x axis + lower node
    std::uint8_t ordinal;  // 1: the second of its edge
    bool inside;           // the lower node is in the material
    float along;           // from the lower node, in cells
};

struct BrickSurface {
    static constexpr std::uint16_t kNone = 0xffff, kSeveral = 0xfffe;

    // Vertices, by edge and crossing, of a cell in which the surface has several pieces.
    struct SeveralPieces {
        std::uint16_t cell;
        std::array<std::array<std::uint16_t, 2>, kCellEdges> vertex;
    };
    // The lower face of a cell along an axis through which the surface passes more than once, and the places
    // where it passes.
    struct CrowdedFace {
        std::uint16_t face;  // 3 cell + axis
        FaceSegments segments;
        std::array<Point3f, 4> middle;
    };
    // A vertex on the lower face of a cell along an axis. Its key names the crossing of an edge of that face,
    // as in FaceSegment.
    struct OnFace {
        std::uint16_t key;
        std::uint32_t vertex;  // in the whole mesh
    };
    static constexpr std::uint16_t key(int face, int edge, int ordinal) {
        return static_cast<std::uint16_t>((face * 4 + edge) * 2 + ordinal);
    }

    BrickCoord coord;
    bool flat = false;                   // one vertex represents all cells
    std::uint32_t first_vertex = 0;      // in the whole mesh
    std::vector<std::uint16_t> cell;     // vertex of each cell, kNone or kSeveral; empty for a flat brick
    std::vector<SeveralPieces> several;  // by cell
    std::vector<CrowdedFace> crowded;    // by face
    std::vector<OnFace> on_faces;        // by edge and ordinal; flat brick: only those on its lower faces
    std::vector<EdgePoint> edges;        // by edge and ordinal; of a flat brick those on its lower faces
    std::vector<Point3f> vertices;

    // Returns the number of crossings of an edge; `first` is set to the first of them.
    int crossings(int axis, int node, const EdgePoint*& first) const;
    // Returns the position of the end of a segment of a face, mm.
    Vec3 on_face(const Lattice& lattice, int node, int axis, FaceSegment::End end) const;
};

// Returns the position of the crossing, a little away from the ends of its edge, mm.
Vec3 edge_point(const Lattice& lattice, const EdgePoint& e);

// Returns the distance in cells by which vertices stay away from the border of their region. With it,
// rounding to single precision does not move them across the border.
double contour_margin(const CarvedField& field);

// Computes the surface in a brick. Empty if there is none.
BrickSurface find_surface(const CarvedField& field, BrickCoord coord, const ContourOptions& options);

}  // namespace tribo::field
