// SPDX-License-Identifier: MIT
// The vertices of a contour by cell and by face, for as many bricks as the following bricks need.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "field/contour/contour_brick.hpp"

namespace tribo::field {

inline constexpr std::uint32_t kNoVertex = 0xffffffff;

// While a mesh grows, its vertices are numbered by kind: those of cells, those on faces, and those of a
// brick's own triangles.
inline constexpr std::uint32_t kOnFace = 0x40000000, kOwn = 0x80000000;

// The stored data of a brick.
struct KnownSurface {
    std::uint32_t first_vertex = kNoVertex;  // kNoVertex: it has no surface
    const BrickSurface* details = nullptr;   // null: flat, without vertices on its faces

    bool is_empty() const { return first_vertex == kNoVertex; }
    bool is_flat() const { return !details || details->flat; }
    bool is_several(int cell) const {
        return !is_flat() && details->cell[static_cast<std::size_t>(cell)] == BrickSurface::kSeveral;
    }
};

// A cell of a brick or of a neighbour one brick back.
struct Cell {
    int back;     // bits of i, j and k: the coordinates in which its brick is one back
    int a, b, c;  // in its brick

    // Makes a cell from its coordinates in the brick itself, -1..6.
    static Cell from(int a, int b, int c) {
        const int back = (a < 0 ? 1 : 0) + (b < 0 ? 2 : 0) + (c < 0 ? 4 : 0);
        return {back, a < 0 ? a + kBrickCells : a, b < 0 ? b + kBrickCells : b, c < 0 ? c + kBrickCells : c};
    }
    int index() const { return cell_index(a, b, c); }
};

// A brick and its neighbours one brick back.
struct SurfacesBehind {
    std::array<KnownSurface, 8> of;  // index: Cell::back

    const KnownSurface& surface(const Cell& at) const { return of[static_cast<std::size_t>(at.back)]; }
    // Returns the vertex of a cell at a crossing of one of its edges, or kNoVertex if the surface does not
    // pass.
    std::uint32_t vertex(const Cell& at, int edge, int ordinal) const {
        const KnownSurface& s = surface(at);
        if (s.is_flat()) return s.first_vertex;
        const auto cell = static_cast<std::uint16_t>(at.index());
        std::uint16_t v = s.details->cell[cell];
        if (v == BrickSurface::kSeveral) {
            v = pieces(*s.details, cell)
                    .vertex[static_cast<std::size_t>(edge)][static_cast<std::size_t>(ordinal)];
        }
        return v == BrickSurface::kNone ? kNoVertex : s.first_vertex + v;
    }
    // Returns the vertex on the lower face of a cell along an axis, or kNoVertex.
    std::uint32_t on_face(const Cell& at, int axis, int edge, int ordinal) const {
        const BrickSurface* s = surface(at).details;
        if (!s || s->on_faces.empty()) return kNoVertex;
        const std::uint16_t key = BrickSurface::key(3 * at.index() + axis, edge, ordinal);
        const auto found =
            std::lower_bound(s->on_faces.begin(), s->on_faces.end(), key,
                             [](const BrickSurface::OnFace& f, std::uint16_t k) { return f.key < k; });
        return found != s->on_faces.end() && found->key == key ? found->vertex : kNoVertex;
    }

  private:
    static const BrickSurface::SeveralPieces& pieces(const BrickSurface& s, std::uint16_t cell) {
        return *std::lower_bound(
            s.several.begin(), s.several.end(), cell,
            [](const BrickSurface::SeveralPieces& p, std::uint16_t c) { return p.cell < c; });
    }
};

// Bricks come in batches, in order of their coordinates: along i, then j, then k. Triangles and vertices of a
// brick use bricks one back in each coordinate. Therefore only the bricks since then are kept, and only the
// vertex number of flat bricks.
class SurfaceTable {
  public:
    // For surfaces in bricks from `first` up to `last` (excluded).
    SurfaceTable(const CarvedField& field, BrickCoord first, BrickCoord last);

    // Largest number of layers in a batch.
    int most_layers() const { return layers_ - 1; }

    // Adds the next bricks, without those that have no vertices. Numbers the vertices of their cells.
    void begin(std::vector<BrickSurface> batch);
    std::span<const BrickSurface> batch() const { return batch_; }
    // Vertices on faces of a brick of the batch, in order; one per segment.
    struct FaceVertex {
        Point3f position;
        std::uint16_t key0, key1;  // the crossings at both ends of the segment, BrickSurface::key
    };
    void add_on_faces(std::size_t n, const std::vector<FaceVertex>& found);
    // Ends the batch. After this only the following bricks may use it.
    void end();

    double margin() const { return margin_; }
    const CarvedField& field() const { return field_; }

    // Returns a brick of the batch with its neighbours one back.
    SurfacesBehind behind(BrickCoord b) const {
        SurfacesBehind found;
        for (int n = 0; n < 8; ++n)
            found.of[static_cast<std::size_t>(n)] =
                surface({b.i - (n & 1), b.j - (n >> 1 & 1), b.k - (n >> 2)});
        return found;
    }
    Vec3 position(std::uint32_t vertex) const {
        return to_double(vertex < kOnFace ? in_cells_[vertex] : on_faces_[vertex - kOnFace]);
    }

    // All vertices so far; they are taken after the last batch.
    std::vector<Point3f>& in_cells() { return in_cells_; }
    std::vector<Point3f>& on_faces() { return on_faces_; }

  private:
    KnownSurface surface(BrickCoord b) const {
        if (b.i < first_.i || b.j < first_.j || b.k < first_.k) return {};
        const Slot& slot = slots_[place(b)];
        if (slot.details == kNoDetails) return {slot.first_vertex, nullptr};
        return {slot.first_vertex, slot.details >= kInBatch ? &batch_[slot.details - kInBatch]
                                                            : &kept_[slot.details - forgotten_]};
    }

    static constexpr std::uint32_t kInBatch = 0x80000000, kNoDetails = kNoVertex;
    struct Slot {
        std::uint32_t first_vertex = kNoVertex;
        std::uint32_t details = kNoDetails;  // kInBatch + index in the batch, or number among all kept
    };

    std::size_t place(BrickCoord b) const {
        return static_cast<std::size_t>(b.i - first_.i) +
               static_cast<std::size_t>(size_i_) *
                   (static_cast<std::size_t>(b.j - first_.j) +
                    static_cast<std::size_t>(size_j_) * static_cast<std::size_t>((b.k - first_.k) % layers_));
    }
    void rise_to(int k);

    const CarvedField& field_;
    BrickCoord first_;
    int size_i_, size_j_, layers_, top_;
    double margin_;
    std::vector<Slot> slots_;  // of the last layers_ layers, used cyclically
    std::vector<BrickSurface> batch_;
    std::deque<BrickSurface> kept_;
    std::uint32_t forgotten_ = 0;  // number of kept bricks that were dropped again
    std::vector<Point3f> in_cells_, on_faces_;
};

}  // namespace tribo::field
