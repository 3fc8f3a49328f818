// SPDX-License-Identifier: MIT
// The vertices of all bricks of a contour, by cell and by face.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "field/contour_brick.hpp"

namespace tribo::field {

inline constexpr std::uint32_t kNoVertex = 0xffffffff;

struct Cell {
    BrickCoord brick;
    int a, b, c;
};

// The surface of each brick, by coordinate.
class SurfaceTable {
  public:
    // Of surfaces in bricks from `first` on up to `last`.
    SurfaceTable(const CarvedField& field, std::vector<BrickSurface>& surfaces, BrickCoord first,
                 BrickCoord last, const TriangleMesh& mesh)
        : field_(field),
          surfaces_(surfaces),
          mesh_(mesh),
          first_(first),
          index_(from_first(last)),
          margin_(contour_margin(field)) {
        for (std::size_t n = 0; n < surfaces.size(); ++n) {
            index_.set(from_first(surfaces[n].coord), static_cast<BrickRef>(n) + kFirstBrick);
        }
    }

    double margin() const { return margin_; }
    const CarvedField& field() const { return field_; }

    // Coordinates of a cell counted from brick `b`, -1..6 along each axis.
    static Cell cell(BrickCoord b, int a, int bb, int c) {
        if (a < 0) --b.i, a += kBrickCells;
        if (bb < 0) --b.j, bb += kBrickCells;
        if (c < 0) --b.k, c += kBrickCells;
        return {b, a, bb, c};
    }
    const BrickSurface* surface(BrickCoord b) const {
        const BrickCoord at = from_first(b);
        if (!index_.contains(at) || index_.get(at) < kFirstBrick) return nullptr;
        return &surfaces_[index_.get(at) - kFirstBrick];
    }
    // The vertex of a cell at a crossing of one of its edges; kNoVertex where the surface does not pass.
    std::uint32_t vertex(const Cell& at, int edge, int ordinal) const {
        const BrickSurface* s = surface(at.brick);
        if (!s) return kNoVertex;
        if (s->flat) return s->first_vertex;
        const auto cell = static_cast<std::uint16_t>(cell_index(at.a, at.b, at.c));
        std::uint16_t v = s->cell[cell];
        if (v == BrickSurface::kSeveral)
            v = pieces(*s, cell).vertex[static_cast<std::size_t>(edge)][static_cast<std::size_t>(ordinal)];
        return v == BrickSurface::kNone ? kNoVertex : s->first_vertex + v;
    }
    // The vertex on the lower face of a cell along an axis, or kNoVertex.
    std::uint32_t on_face(const Cell& at, int axis, int edge, int ordinal) const {
        const BrickSurface* s = surface(at.brick);
        if (!s || s->on_faces.empty()) return kNoVertex;
        const std::uint16_t key = BrickSurface::key(3 * cell_index(at.a, at.b, at.c) + axis, edge, ordinal);
        const auto found =
            std::lower_bound(s->on_faces.begin(), s->on_faces.end(), key,
                             [](const BrickSurface::OnFace& f, std::uint16_t k) { return f.key < k; });
        return found != s->on_faces.end() && found->key == key ? found->vertex : kNoVertex;
    }
    static const BrickSurface::SeveralPieces& pieces(const BrickSurface& s, std::uint16_t cell) {
        return *std::lower_bound(
            s.several.begin(), s.several.end(), cell,
            [](const BrickSurface::SeveralPieces& p, std::uint16_t c) { return p.cell < c; });
    }
    Vec3 position(std::uint32_t vertex) const { return mesh_.position(vertex); }

  private:
    BrickCoord from_first(BrickCoord b) const { return {b.i - first_.i, b.j - first_.j, b.k - first_.k}; }

    const CarvedField& field_;
    const std::vector<BrickSurface>& surfaces_;
    const TriangleMesh& mesh_;
    BrickCoord first_;
    BrickIndex index_;
    double margin_;
};

}  // namespace tribo::field
