// SPDX-License-Identifier: MIT
#include "field/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "field/contour_brick.hpp"
#include "field/contour_polygon.hpp"

namespace tribo::field {
namespace {

constexpr std::uint32_t kNoVertex = 0xffffffff;
// Vertices of a brick's own triangles, counted from here until the mesh is put together.
constexpr std::uint32_t kOwn = 0x80000000;

// All bricks from `first` on up to `last` that the surface may pass through, in the order of their
// coordinates.
std::vector<BrickCoord> candidate_bricks(const CarvedField& field, BrickCoord first, BrickCoord last) {
    const double radius = field.brick_radius_mm() + field.cell_mm();
    const auto untouched_around = [&](BrickCoord b) {
        for (int k = b.k - 1; k <= b.k + 1; ++k) {
            for (int j = b.j - 1; j <= b.j + 1; ++j) {
                for (int i = b.i - 1; i <= b.i + 1; ++i) {
                    if (field.contains({i, j, k}) && field.ref({i, j, k}) != kUntouched) return false;
                }
            }
        }
        return true;
    };
    std::vector<BrickCoord> found;
    for (int k = first.k; k < last.k; ++k) {
        for (int j = first.j; j < last.j; ++j) {
            for (int i = first.i; i < last.i; ++i) {
                const BrickRef ref = field.ref({i, j, k});
                if (ref == kAir) continue;
                if (ref == kUntouched && untouched_around({i, j, k}) &&
                    std::abs(field.blank().distance_mm(field.centre({i, j, k}))) > radius)
                    continue;
                found.push_back({i, j, k});
            }
        }
    }
    return found;
}

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

// What the surface passes on one face between two cells: a vertex for each segment, at both its ends.
struct FaceVertex {
    Point3f position;
    std::uint16_t key0, key1;
};

class FaceVertices {
  public:
    FaceVertices(const SurfaceTable& table, const BrickSurface& surface)
        : table_(table), s_(surface), lattice_(table.field().lattice(surface.coord)) {}

    std::vector<FaceVertex> find() {
        for (int c = 0; c < kBrickCells; ++c) {
            for (int b = 0; b < kBrickCells; ++b) {
                for (int a = 0; a < kBrickCells; ++a) {
                    // Inside a flat brick nothing is needed.
                    if (s_.flat && a > 0 && b > 0 && c > 0) continue;
                    if (!s_.flat &&
                        s_.cell[static_cast<std::size_t>(cell_index(a, b, c))] == BrickSurface::kNone)
                        continue;
                    const int at[3] = {a, b, c};
                    for (int axis = 0; axis < 3; ++axis) {
                        if (s_.flat && at[axis] > 0) continue;
                        look_at(
                            SurfaceTable::cell(s_.coord, a - (axis == 0), b - (axis == 1), c - (axis == 2)),
                            {s_.coord, a, b, c}, axis);
                    }
                }
            }
        }
        return std::move(found_);
    }

  private:
    static bool is_several(const BrickSurface& s, const Cell& at) {
        return !s.flat &&
               s.cell[static_cast<std::size_t>(cell_index(at.a, at.b, at.c))] == BrickSurface::kSeveral;
    }

    void look_at(const Cell& below, const Cell& above, int axis) {
        const BrickSurface* lower = surface_of(below);
        if (!lower || (lower->flat && s_.flat)) return;
        const int cell = cell_index(above.a, above.b, above.c);
        const int node = node_index(above.a, above.b, above.c);
        const auto face = static_cast<std::uint16_t>(3 * cell + axis);
        const auto crowded =
            std::lower_bound(s_.crowded.begin(), s_.crowded.end(), face,
                             [](const BrickSurface::CrowdedFace& f, std::uint16_t n) { return f.face < n; });
        const bool several = is_several(s_, above) || is_several(*lower, below);
        if (crowded != s_.crowded.end() && crowded->face == face) {
            if (crowded->segments.count == 1 && !several) return;
            for (int k = 0; k < crowded->segments.count; ++k)
                add(face, crowded->segments.all[static_cast<std::size_t>(k)],
                    crowded->middle[static_cast<std::size_t>(k)]);
            return;
        }
        if (!several && !lower->flat && !s_.flat) return;
        FaceSegment segment;
        if (!only_segment(node, axis, segment)) return;
        if (!several) {
            const std::uint32_t p = any_vertex(*lower, below), q = any_vertex(s_, above);
            if (p == kNoVertex || q == kNoVertex || passes(node, axis, p, q)) return;
        }
        add(face, segment,
            to_float(0.5 * (s_.on_face(lattice_, node, axis, segment.from) +
                            s_.on_face(lattice_, node, axis, segment.to))));
    }

    // The one segment of a face that is crossed at two of its edges.
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

    static std::uint32_t any_vertex(const BrickSurface& s, const Cell& at) {
        if (s.flat) return s.first_vertex;
        const std::uint16_t v = s.cell[static_cast<std::size_t>(cell_index(at.a, at.b, at.c))];
        return v == BrickSurface::kNone ? kNoVertex : s.first_vertex + v;
    }

    // Whether the way from one vertex to the other passes through the face.
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

    const BrickSurface* surface_of(const Cell& at) const {
        return at.brick == s_.coord ? &s_ : table_.surface(at.brick);
    }

    const SurfaceTable& table_;
    const BrickSurface& s_;
    Lattice lattice_;
    std::vector<FaceVertex> found_;
};

struct BrickTriangles {
    std::vector<Triangle> triangles;
    std::vector<Point3f> own;
};

// The polygons around the crossings of the edges that a brick owns.
class BrickPolygons {
  public:
    BrickPolygons(const SurfaceTable& table, const BrickSurface& surface)
        : table_(table), s_(surface), lattice_(table.field().lattice(surface.coord)) {}

    BrickTriangles find() {
        for (std::size_t n = 0; n < s_.edges.size(); ++n) {
            const EdgePoint& e = s_.edges[n];
            const bool alone = e.ordinal == 0 && (n + 1 == s_.edges.size() || s_.edges[n + 1].ordinal == 0);
            around(e, alone);
        }
        return std::move(out_);
    }

  private:
    void around(const EdgePoint& e, bool alone) {
        const int axis = e.edge / kLatticeNodes, node = e.edge % kLatticeNodes;
        const int a = node % kLatticeEdge, b = node / kLatticeEdge % kLatticeEdge,
                  c = node / (kLatticeEdge * kLatticeEdge);
        if (a == kBrickCells || b == kBrickCells || c == kBrickCells) return;
        // Inside a flat brick all polygons shrink to a point: only edges on its lower faces matter.
        if (s_.flat && a > 0 && b > 0 && c > 0) return;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto cell = [&](int along_u, int along_v) {
            int at[3] = {a, b, c};
            at[u] -= along_u;
            at[v] -= along_v;
            return SurfaceTable::cell(s_.coord, at[0], at[1], at[2]);
        };
        const std::array<Cell, 4> cells{cell(0, 0), cell(1, 0), cell(1, 1), cell(0, 1)};
        // The faces between a cell and the next: lower face of which cell, along which axis, and which of its
        // edges this is.
        constexpr std::size_t kAbove[4] = {0, 1, 3, 0};
        const int normals[4] = {u, v, u, v};
        constexpr int kEdges[4] = {3, 2, 1, 0};
        constexpr int kCellEdge[4] = {0, 1, 3, 2};
        ring_.clear();
        bool on_faces = false;
        for (std::size_t n = 0; n < 4; ++n) {
            const std::uint32_t vertex = table_.vertex(cells[n], 4 * axis + kCellEdge[n], e.ordinal);
            if (vertex == kNoVertex) return;
            if (ring_.empty() || ring_.back() != vertex) ring_.push_back(vertex);
            const std::uint32_t face = table_.on_face(cells[kAbove[n]], normals[n], kEdges[n], e.ordinal);
            if (face == kNoVertex) continue;
            on_faces = true;
            ring_.push_back(face);
        }
        if (ring_.size() > 1 && ring_.front() == ring_.back()) ring_.pop_back();
        if (ring_.size() < 3) return;
        // Counter-clockwise about the axis: the outside is ahead where the edge starts inside.
        const bool flip = e.inside == (e.ordinal == 1);
        if (on_faces || !alone || !few(e, flip)) fan(e, flip);
    }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool flip) {
        out_.triangles.push_back(flip ? Triangle{a, c, b} : Triangle{a, b, c});
    }

    // One or two triangles, where these meet no others.
    bool few(const EdgePoint& e, bool flip) {
        const int axis = e.edge / kLatticeNodes, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const Vec3 from = node_mm(lattice_, e.edge % kLatticeNodes);
        std::array<Vec3, 4> seen;
        for (std::size_t n = 0; n < ring_.size(); ++n) {
            const Vec3 p = (table_.position(ring_[n]) - from) / lattice_.cell_mm;
            seen[n] = {p[u], p[v], p[axis]};
        }
        if (ring_.size() == 3) {
            if (!triangle_stays(std::span<const Vec3, 3>(seen.data(), 3), table_.margin())) return false;
            emit(ring_[0], ring_[1], ring_[2], flip);
            return true;
        }
        const int first = diagonal_from(seen, static_cast<double>(e.along), table_.margin());
        if (first < 0) return false;
        const auto at = [&](int n) { return ring_[static_cast<std::size_t>((first + n) % 4)]; };
        emit(at(0), at(1), at(2), flip);
        emit(at(0), at(2), at(3), flip);
        return true;
    }

    void fan(const EdgePoint& e, bool flip) {
        const std::uint32_t middle = kOwn + static_cast<std::uint32_t>(out_.own.size());
        out_.own.push_back(to_float(edge_point(lattice_, e)));
        for (std::size_t n = 0; n < ring_.size(); ++n)
            emit(middle, ring_[n], ring_[(n + 1) % ring_.size()], flip);
    }

    const SurfaceTable& table_;
    const BrickSurface& s_;
    Lattice lattice_;
    std::vector<std::uint32_t> ring_;
    BrickTriangles out_;
};

// The surfaces of the bricks from `first` on up to `last`; their vertices, in order, become the mesh's.
std::vector<BrickSurface> find_surfaces(const CarvedField& field, BrickCoord first, BrickCoord last,
                                        const ParallelFor& parallel, const ContourOptions& options,
                                        TriangleMesh& mesh) {
    const std::vector<BrickCoord> bricks = candidate_bricks(field, first, last);
    std::vector<BrickSurface> found(bricks.size());
    parallel(bricks.size(), [&](std::size_t n) { found[n] = find_surface(field, bricks[n], options); });
    std::erase_if(found, [](const BrickSurface& s) { return s.vertices.empty(); });
    for (BrickSurface& s : found) {
        s.first_vertex = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), s.vertices.begin(), s.vertices.end());
        s.vertices = {};
    }
    const SurfaceTable table(field, found, first, last, mesh);
    std::vector<std::vector<FaceVertex>> on_faces(found.size());
    parallel(found.size(), [&](std::size_t n) { on_faces[n] = FaceVertices(table, found[n]).find(); });
    for (std::size_t n = 0; n < found.size(); ++n) {
        for (const FaceVertex& f : on_faces[n]) {
            const auto vertex = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(f.position);
            found[n].on_faces.push_back({f.key0, vertex});
            found[n].on_faces.push_back({f.key1, vertex});
        }
        std::sort(found[n].on_faces.begin(), found[n].on_faces.end(),
                  [](const auto& a, const auto& b) { return a.key < b.key; });
    }
    return found;
}

void append(TriangleMesh& mesh, const BrickTriangles& part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.own.begin(), part.own.end());
    for (Triangle t : part.triangles) {
        for (std::uint32_t& v : t) {
            if (v >= kOwn) v = v - kOwn + first;
        }
        mesh.triangles.push_back(t);
    }
}

// Drops the vertices that no triangle uses.
void drop_unused(TriangleMesh& mesh) {
    std::vector<std::uint32_t> renamed(mesh.positions.size(), kNoVertex);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) renamed[v] = 0;
    }
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < renamed.size(); ++v) {
        if (renamed[v] == kNoVertex) continue;
        renamed[v] = kept;
        mesh.positions[kept++] = mesh.positions[v];
    }
    mesh.positions.resize(kept);
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& v : t) v = renamed[v];
    }
}

}  // namespace

TriangleMesh contour(const CarvedField& field, const ParallelFor& parallel, const ContourOptions& options) {
    TriangleMesh mesh;
    std::vector<BrickSurface> found = find_surfaces(field, {}, field.size(), parallel, options, mesh);
    const SurfaceTable table(field, found, {}, field.size(), mesh);
    std::vector<BrickTriangles> parts(found.size());
    parallel(found.size(), [&](std::size_t n) { parts[n] = BrickPolygons(table, found[n]).find(); });
    for (BrickTriangles& part : parts) {
        append(mesh, part);
        part = {};
    }
    return mesh;
}

TriangleMesh contour_part(const CarvedField& field, BrickCoord first, BrickCoord last,
                          const ContourOptions& options) {
    const BrickCoord size = field.size();
    last = {std::min(last.i, size.i), std::min(last.j, size.j), std::min(last.k, size.k)};
    // A brick's triangles reach for vertices one brick back.
    const BrickCoord back{std::max(first.i - 1, 0), std::max(first.j - 1, 0), std::max(first.k - 1, 0)};
    TriangleMesh mesh;
    std::vector<BrickSurface> found = find_surfaces(field, back, last, serial_for, options, mesh);
    const SurfaceTable table(field, found, back, last, mesh);
    for (const BrickSurface& s : found) {
        if (s.coord.i < first.i || s.coord.j < first.j || s.coord.k < first.k) continue;
        append(mesh, BrickPolygons(table, s).find());
    }
    drop_unused(mesh);
    return mesh;
}

}  // namespace tribo::field
