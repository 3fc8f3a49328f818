// SPDX-License-Identifier: MIT
#include "field/contour/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "field/contour/contour_candidates.hpp"
#include "field/contour/contour_faces.hpp"
#include "field/contour/contour_polygon.hpp"

namespace tribo::field {
namespace {

// Approximate number of bricks in a batch: enough for all threads, few enough to keep their data small.
constexpr std::size_t kBatch = 4096;

struct BrickTriangles {
    std::vector<Triangle> triangles;
    std::vector<Point3f> own;
};

// The polygons around the crossings of the edges that a brick owns.
class BrickPolygons {
  public:
    BrickPolygons(const SurfaceTable& table, const BrickSurface& surface)
        : table_(table),
          s_(surface),
          lattice_(table.field().lattice(surface.coord)),
          behind_(table.behind(surface.coord)) {}

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
        // Inside a flat brick all polygons shrink to a point. Only edges on its lower faces matter.
        if (s_.flat && a > 0 && b > 0 && c > 0) return;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto cell = [&](int along_u, int along_v) {
            int at[3] = {a, b, c};
            at[u] -= along_u;
            at[v] -= along_v;
            return Cell::from(at[0], at[1], at[2]);
        };
        const std::array<Cell, 4> cells{cell(0, 0), cell(1, 0), cell(1, 1), cell(0, 1)};
        // For each face between a cell and the next one: the cell whose lower face it is, its axis, and the
        // number of this edge in the face.
        constexpr std::size_t kAbove[4] = {0, 1, 3, 0};
        const int normals[4] = {u, v, u, v};
        constexpr int kEdges[4] = {3, 2, 1, 0};
        constexpr int kCellEdge[4] = {0, 1, 3, 2};
        ring_.clear();
        bool on_faces = false;
        for (std::size_t n = 0; n < 4; ++n) {
            const std::uint32_t vertex = behind_.vertex(cells[n], 4 * axis + kCellEdge[n], e.ordinal);
            if (vertex == kNoVertex) return;
            if (ring_.empty() || ring_.back() != vertex) ring_.push_back(vertex);
            const std::uint32_t face = behind_.on_face(cells[kAbove[n]], normals[n], kEdges[n], e.ordinal);
            if (face == kNoVertex) continue;
            on_faces = true;
            ring_.push_back(face);
        }
        if (ring_.size() > 1 && ring_.front() == ring_.back()) ring_.pop_back();
        if (ring_.size() < 3) return;
        // Counter-clockwise about the axis: if the edge starts inside, the outside is ahead.
        const bool flip = e.inside == (e.ordinal == 1);
        if (on_faces || !alone || !few(e, flip)) fan(e, flip);
    }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool flip) {
        out_.triangles.push_back(flip ? Triangle{a, c, b} : Triangle{a, b, c});
    }

    // One or two triangles, if these meet no others. Returns false otherwise.
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
    SurfacesBehind behind_;
    std::vector<std::uint32_t> ring_;
    BrickTriangles out_;
};

// Makes a mesh batch by batch.
class Contour {
  public:
    // Only the bricks from `first` on get triangles; the bricks from `back` on are read.
    Contour(const CarvedField& field, BrickCoord back, BrickCoord first, BrickCoord last,
            const ParallelFor& parallel, const ContourOptions& options)
        : field_(field),
          back_(back),
          first_(first),
          last_(last),
          parallel_(parallel),
          options_(options),
          table_(field, back, last) {}

    TriangleMesh mesh() {
        CandidateBricks candidates(field_, back_, last_);
        std::vector<BrickCoord> bricks;
        int layers = 0;
        for (int k = back_.k; k < last_.k; ++k) {
            candidates.append_layer(k, bricks);
            if (++layers < table_.most_layers() && bricks.size() < kBatch && k + 1 < last_.k) continue;
            for (std::size_t from = 0; from < bricks.size(); from += kBatch)
                add(std::span(bricks).subspan(from, std::min(kBatch, bricks.size() - from)));
            bricks.clear();
            layers = 0;
        }
        return join();
    }

  private:
    void add(std::span<const BrickCoord> bricks) {
        std::vector<BrickSurface> found(bricks.size());
        parallel_(bricks.size(),
                  [&](std::size_t n) { found[n] = find_surface(field_, bricks[n], options_); });
        table_.begin(std::move(found));
        const std::span<const BrickSurface> batch = table_.batch();
        std::vector<std::vector<SurfaceTable::FaceVertex>> on_faces(batch.size());
        parallel_(batch.size(), [&](std::size_t n) { on_faces[n] = find_face_vertices(table_, batch[n]); });
        for (std::size_t n = 0; n < batch.size(); ++n) {
            if (!on_faces[n].empty()) table_.add_on_faces(n, on_faces[n]);
        }
        std::vector<BrickTriangles> parts(batch.size());
        parallel_(batch.size(), [&](std::size_t n) {
            const BrickCoord b = batch[n].coord;
            if (b.i >= first_.i && b.j >= first_.j && b.k >= first_.k)
                parts[n] = BrickPolygons(table_, batch[n]).find();
        });
        for (const BrickTriangles& part : parts) append(part);
        table_.end();
    }

    void append(const BrickTriangles& part) {
        const auto before = static_cast<std::uint32_t>(own_.size());
        own_.insert(own_.end(), part.own.begin(), part.own.end());
        for (Triangle t : part.triangles) {
            for (std::uint32_t& v : t) {
                if (v >= kOwn) v += before;
            }
            triangles_.push_back(t);
        }
    }

    // Joins the vertices: first those of cells, then those on faces, then those of the bricks' own triangles.
    TriangleMesh join() {
        TriangleMesh mesh;
        mesh.positions = std::move(table_.in_cells());
        const auto on_faces = static_cast<std::uint32_t>(mesh.positions.size());
        const auto own = on_faces + static_cast<std::uint32_t>(table_.on_faces().size());
        mesh.positions.reserve(own + own_.size());
        mesh.positions.insert(mesh.positions.end(), table_.on_faces().begin(), table_.on_faces().end());
        mesh.positions.insert(mesh.positions.end(), own_.begin(), own_.end());
        mesh.triangles = std::move(triangles_);
        for (Triangle& t : mesh.triangles) {
            for (std::uint32_t& v : t) {
                if (v >= kOwn) {
                    v = v - kOwn + own;
                } else if (v >= kOnFace) {
                    v = v - kOnFace + on_faces;
                }
            }
        }
        return mesh;
    }

    const CarvedField& field_;
    BrickCoord back_, first_, last_;
    const ParallelFor& parallel_;
    const ContourOptions& options_;
    SurfaceTable table_;
    std::vector<Triangle> triangles_;
    std::vector<Point3f> own_;
};

}  // namespace

TriangleMesh contour(const CarvedField& field, const ParallelFor& parallel, const ContourOptions& options) {
    return Contour(field, {}, {}, field.size(), parallel, options).mesh();
}

TriangleMesh contour_part(const CarvedField& field, BrickCoord first, BrickCoord last,
                          const ContourOptions& options) {
    const BrickCoord size = field.size();
    last = {std::min(last.i, size.i), std::min(last.j, size.j), std::min(last.k, size.k)};
    // The triangles of a brick use vertices one brick back.
    const BrickCoord back{std::max(first.i - 1, 0), std::max(first.j - 1, 0), std::max(first.k - 1, 0)};
    const ParallelFor serial = serial_for;
    TriangleMesh mesh = Contour(field, back, first, last, serial, options).mesh();
    drop_unused(mesh);
    return mesh;
}

}  // namespace tribo::field
