// SPDX-License-Identifier: MIT
#include "field/contour/contour_faces.hpp"

#include <utility>

#include "field/contour/contour_corner.hpp"

namespace tribo::field {
namespace {

class FaceVertices {
  public:
    FaceVertices(const SurfaceTable& table, const BrickSurface& surface)
        : table_(table),
          s_(surface),
          lattice_(table.field().lattice(surface.coord)),
          ref_(table.field().ref(surface.coord)),
          behind_(table.behind(surface.coord)) {}

    std::vector<SurfaceTable::FaceVertex> find() {
        if (s_.flat && flat_below()) return {};
        for (int c = 0; c < kBrickCells; ++c) {
            for (int b = 0; b < kBrickCells; ++b) {
                for (int a = 0; a < kBrickCells; ++a) {
                    // Inside a flat brick no vertices are needed.
                    if (s_.flat && a > 0 && b > 0 && c > 0) continue;
                    if (!s_.flat &&
                        s_.cell[static_cast<std::size_t>(cell_index(a, b, c))] == BrickSurface::kNone)
                        continue;
                    const int at[3] = {a, b, c};
                    for (int axis = 0; axis < 3; ++axis) {
                        if (s_.flat && at[axis] > 0) continue;
                        look_at(Cell::from(a - (axis == 0), b - (axis == 1), c - (axis == 2)), {0, a, b, c},
                                axis);
                    }
                }
            }
        }
        return std::move(found_);
    }

  private:
    // Returns true if the bricks below along each axis are flat too or have no surface.
    bool flat_below() const {
        return behind_.of[1].is_flat() && behind_.of[2].is_flat() && behind_.of[4].is_flat();
    }

    void look_at(const Cell& below, const Cell& above, int axis) {
        const KnownSurface &lower = behind_.surface(below), &own = behind_.of[0];
        if (lower.is_empty() || (lower.is_flat() && s_.flat)) return;
        const int cell = above.index();
        const int node = node_index(above.a, above.b, above.c);
        const auto face = static_cast<std::uint16_t>(3 * cell + axis);
        const auto crowded =
            std::lower_bound(s_.crowded.begin(), s_.crowded.end(), face,
                             [](const BrickSurface::CrowdedFace& f, std::uint16_t n) { return f.face < n; });
        const bool several = own.is_several(cell) || lower.is_several(below.index());
        if (crowded != s_.crowded.end() && crowded->face == face) {
            if (crowded->segments.count == 1 && !several) return;
            for (int k = 0; k < crowded->segments.count; ++k)
                add(face, crowded->segments.all[static_cast<std::size_t>(k)],
                    crowded->middle[static_cast<std::size_t>(k)]);
            return;
        }
        if (!several && !lower.is_flat() && !s_.flat) return;
        FaceSegment segment;
        if (!only_segment(node, axis, segment)) return;
        if (!several) {
            const std::uint32_t p = any_vertex(lower, below), q = any_vertex(own, above);
            if (p == kNoVertex || q == kNoVertex || passes(node, axis, p, q)) return;
        }
        const Vec3 from = s_.on_face(lattice_, node, axis, segment.from);
        const Vec3 to = s_.on_face(lattice_, node, axis, segment.to);
        const double off_mm = table_.margin() * lattice_.cell_mm;
        add(face, segment,
            to_float(corner_on_face(table_.field(), ref_, from, to, axis, node_mm(lattice_, node), off_mm)));
    }

    // Finds the one segment of a face that is crossed at two of its edges. Returns false if there is another
    // number of crossed edges.
    bool only_segment(int node, int axis, FaceSegment& segment) const {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        int count = 0;
        for (std::uint8_t e = 0; e < 4; ++e) {
            const int from = e == 1 ? node + kStep[u] : e == 2 ? node + kStep[v] : node;
            const EdgePoint* first = nullptr;
            if (s_.crossings(e % 2 == 0 ? u : v, from, first) == 0) continue;
            (count++ == 0 ? segment.from : segment.to) = {e, 0};
        }
        return count == 2;
    }

    static std::uint32_t any_vertex(const KnownSurface& s, const Cell& at) {
        if (s.is_flat()) return s.first_vertex;
        const std::uint16_t v = s.details->cell[static_cast<std::size_t>(at.index())];
        return v == BrickSurface::kNone ? kNoVertex : s.first_vertex + v;
    }

    // Returns true if the line from one vertex to the other passes through the face.
    bool passes(int node, int axis, std::uint32_t p, std::uint32_t q) const {
        const Vec3 corner = node_mm(lattice_, node);
        const Vec3 a = table_.position(p) - corner, b = table_.position(q) - corner;
        const Vec3 x = lerp(a, b, a[axis] / (a[axis] - b[axis]));
        const double low = table_.margin() * lattice_.cell_mm,
                     high = (1 - table_.margin()) * lattice_.cell_mm;
        for (const int side : {(axis + 1) % 3, (axis + 2) % 3}) {
            if (!(x[side] > low && x[side] < high)) return false;
        }
        return true;
    }

    void add(int face, const FaceSegment& s, const Point3f& at) {
        found_.push_back({at, BrickSurface::key(face, s.from.edge, s.from.ordinal),
                          BrickSurface::key(face, s.to.edge, s.to.ordinal)});
    }

    const SurfaceTable& table_;
    const BrickSurface& s_;
    Lattice lattice_;
    BrickRef ref_;
    SurfacesBehind behind_;
    std::vector<SurfaceTable::FaceVertex> found_;
};

}  // namespace

std::vector<SurfaceTable::FaceVertex> find_face_vertices(const SurfaceTable& table,
                                                         const BrickSurface& surface) {
    return FaceVertices(table, surface).find();
}

}  // namespace tribo::field
