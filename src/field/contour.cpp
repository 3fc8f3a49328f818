// SPDX-License-Identifier: MIT
#include "field/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "field/contour_faces.hpp"
#include "field/contour_polygon.hpp"

namespace tribo::field {
namespace {

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
    parallel(found.size(), [&](std::size_t n) { on_faces[n] = find_face_vertices(table, found[n]); });
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
