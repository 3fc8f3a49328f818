// SPDX-License-Identifier: MIT
#include "field/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "field/quadric.hpp"

namespace tribo::field {
namespace {

constexpr int kCells = kBrickCells * kBrickCells * kBrickCells;
constexpr std::uint16_t kNone = 0xffff;
// Nodes along x, y, z from a node to the other end of the edge that it owns.
constexpr int kStep[3] = {1, kLatticeEdge, kLatticeEdge* kLatticeEdge};

constexpr int cell_index(int a, int b, int c) {
    return a + kBrickCells * (b + kBrickCells * c);
}

struct Crossing {
    Vec3 point, normal;
    ShapeId shape;
};

// The part of the mesh that belongs to one brick.
struct BrickSurface {
    BrickCoord coord;
    bool flat = false;                // one vertex stands for all cells
    std::uint32_t first_vertex = 0;   // in the whole mesh
    std::vector<std::uint16_t> cell;  // vertex of each cell, or kNone; empty for a flat brick
    std::vector<Point3f> vertices;
};

Point3f to_float(Vec3 p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

// Works on one brick at a time: nodes, then crossings of the surface with the edges, then one vertex per
// cell.
class BrickContour {
  public:
    BrickContour(const CarvedField& field, BrickCoord coord)
        : field_(field), coord_(coord), ref_(field.ref(coord)) {
        if (ref_ >= kFirstBrick) {
            nodes_ = field.brick(ref_).distance_mm.data();
        } else {
            field.blank().sample(field.lattice(coord), sampled_.data());
            nodes_ = sampled_.data();
        }
    }

    bool inside(int node) const { return nodes_[node] < 0; }

    bool has_surface() const {
        int in = 0;
        for (int n = 0; n < kLatticeNodes; ++n) in += static_cast<int>(inside(n));
        return in != 0 && in != kLatticeNodes;
    }

    BrickSurface surface(const ContourOptions& options) {
        BrickSurface s;
        s.coord = coord_;
        find_crossings();
        if (is_plane(options)) {
            s.flat = true;
            Vec3 mean;
            for (const Crossing& c : crossings_) mean += c.point;
            s.vertices.push_back(to_float(mean / static_cast<double>(crossings_.size())));
            return s;
        }
        s.cell.assign(kCells, kNone);
        for (int c = 0; c < kBrickCells; ++c) {
            for (int b = 0; b < kBrickCells; ++b) {
                for (int a = 0; a < kBrickCells; ++a) place_vertex(s, a, b, c);
            }
        }
        return s;
    }

  private:
    void find_crossings() {
        const Lattice lattice = field_.lattice(coord_);
        for (auto& axis : crossing_of_) axis.fill(kNone);
        for (int c = 0; c < kLatticeEdge; ++c) {
            for (int b = 0; b < kLatticeEdge; ++b) {
                for (int a = 0; a < kLatticeEdge; ++a) {
                    const int at[3] = {a, b, c};
                    const int n = node_index(a, b, c);
                    for (int axis = 0; axis < 3; ++axis) {
                        if (at[axis] == kBrickCells || inside(n) == inside(n + kStep[axis])) continue;
                        crossing_of_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(n)] =
                            static_cast<std::uint16_t>(crossings_.size());
                        crossings_.push_back(
                            crossing(lattice.node(a, b, c), axis, nodes_[n], nodes_[n + kStep[axis]]));
                    }
                }
            }
        }
    }

    // Regula falsi (Illinois) along an edge whose ends lie on either side; starts from the node values, which
    // are themselves distances, so one or two looks at the exact level are the rule.
    Crossing crossing(Vec3 from, int axis, double d0, double d1) const {
        constexpr double kDone = 1e-7;  // mm
        constexpr int kMost = 12;
        double t0 = 0, t1 = 1;
        Vec3 p = from;
        CarvedField::Exact e{0, 0};
        int side = 0;
        for (int n = 0; n < kMost; ++n) {
            const double t = t0 + (t1 - t0) * d0 / (d0 - d1);
            p[axis] = from[axis] + t * field_.cell_mm();
            e = field_.exact(ref_, p);
            if (std::abs(e.distance_mm) < kDone) break;
            if ((e.distance_mm < 0) == (d0 < 0)) {
                t0 = t;
                d0 = e.distance_mm;
                if (side == 1) d1 *= 0.5;
                side = 1;
            } else {
                t1 = t;
                d1 = e.distance_mm;
                if (side == -1) d0 *= 0.5;
                side = -1;
            }
        }
        return {p, normal(e.shape, p), e.shape};
    }

    // Distance to the surface of one shape and the direction out of the material that it bounds.
    double distance(ShapeId shape, Vec3 p) const {
        const double d = field_.shape(shape).distance_mm(p);
        return shape == 0 ? d : -d;
    }
    Vec3 normal(ShapeId shape, Vec3 p) const {
        const Vec3 g = field_.shape(shape).gradient(p);
        return shape == 0 ? g : -g;
    }

    // The plane that touches the face of a crossing beside `p`: a share `back` of the way to the crossing, so
    // that it is still this face of its shape that answers and not the one that it meets at p.
    struct Tangent {
        Vec3 point, normal;
    };
    Tangent tangent_near(const Crossing& x, Vec3 p, double back) const {
        const Vec3 beside = lerp(p - dot(p - x.point, x.normal) * x.normal, x.point, back);
        const Vec3 n = normal(x.shape, beside);
        constexpr double kSameFace = 0.8;  // cosine of the turn within a cell
        if (dot(n, x.normal) < kSameFace) return {x.point, x.normal};
        return {beside - distance(x.shape, beside) * n, n};
    }

    bool is_plane(const ContourOptions& options) const {
        const Crossing& first = crossings_.front();
        return std::all_of(crossings_.begin(), crossings_.end(), [&](const Crossing& c) {
            return squared_length(c.normal - first.normal) <
                       options.flat_angle_rad * options.flat_angle_rad &&
                   std::abs(dot(c.point - first.point, first.normal)) < options.flat_cells * field_.cell_mm();
        });
    }

    void place_vertex(BrickSurface& s, int a, int b, int c) const {
        const int n = node_index(a, b, c);
        Quadric quadric;
        std::array<const Crossing*, 12> around;
        std::size_t count = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const int u = kStep[(axis + 1) % 3], v = kStep[(axis + 2) % 3];
            for (const int edge : {n, n + u, n + v, n + u + v}) {
                const std::uint16_t k =
                    crossing_of_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(edge)];
                if (k == kNone) continue;
                around[count++] = &crossings_[k];
                quadric.add(crossings_[k].point, crossings_[k].normal);
            }
        }
        if (quadric.count() == 0) return;
        const Vec3 lo = field_.lattice(coord_).node(a, b, c);
        const auto into_cell = [&](Vec3 p) {
            for (int axis = 0; axis < 3; ++axis)
                p[axis] = std::clamp(p[axis], lo[axis], lo[axis] + field_.cell_mm());
            return p;
        };
        // Planes through the crossings miss a curved surface by their sagitta; Newton steps take that away:
        // onto the one surface where it is smooth, onto the meeting of its faces where it is not.
        constexpr double kSmooth = 0.1;  // rad
        Vec3 p;
        if (quadric.is_flat(kSmooth)) {
            p = into_cell(quadric.mean());
            const CarvedField::Exact e = field_.exact(ref_, p);
            if (std::abs(e.distance_mm) < 0.5 * field_.cell_mm()) p -= e.distance_mm * normal(e.shape, p);
        } else {
            p = into_cell(quadric.solve());
            for (const double back : {0.3, 0.03}) {
                Quadric planes;
                for (std::size_t k = 0; k < count; ++k) {
                    const Tangent t = tangent_near(*around[k], p, back);
                    planes.add(t.point, t.normal);
                }
                p = into_cell(planes.solve());
            }
        }
        s.cell[static_cast<std::size_t>(cell_index(a, b, c))] = static_cast<std::uint16_t>(s.vertices.size());
        s.vertices.push_back(to_float(p));
    }

    const CarvedField& field_;
    BrickCoord coord_;
    BrickRef ref_;
    const float* nodes_ = nullptr;
    std::array<float, kLatticeNodes> sampled_;
    std::array<std::array<std::uint16_t, kLatticeNodes>, 3> crossing_of_;
    std::vector<Crossing> crossings_;
};

// All bricks from `first` on up to `last` that the surface may pass through, in the order of their
// coordinates.
std::vector<BrickCoord> candidate_bricks(const CarvedField& field, BrickCoord first, BrickCoord last) {
    const double brick = kBrickCells * field.cell_mm();
    const auto blank_distance = [&](BrickCoord b, int bricks) {
        const double half = 0.5 * bricks * brick;
        return std::abs(field.blank().distance_mm(field.lattice(b).node(0, 0, 0) + Vec3{half, half, half}));
    };
    std::vector<BrickCoord> found;
    for (int k = first.k; k < last.k; ++k) {
        for (int j = first.j; j < last.j; ++j) {
            for (int i = first.i; i < last.i; ++i) {
                const BrickRef ref = field.ref({i, j, k});
                if (ref == kAir) continue;
                if (ref == kUntouched && blank_distance({i, j, k}, 1) > 0.87 * brick) continue;
                found.push_back({i, j, k});
            }
        }
    }
    return found;
}

// Where the surface of each brick stands in the list, by coordinate.
class SurfaceTable {
  public:
    // Of surfaces in bricks from `first` on up to `last`.
    SurfaceTable(const std::vector<BrickSurface>& surfaces, BrickCoord first, BrickCoord last)
        : surfaces_(surfaces), first_(first), index_(from_first(last)) {
        for (std::size_t n = 0; n < surfaces.size(); ++n) {
            index_.set(from_first(surfaces[n].coord), static_cast<BrickRef>(n) + kFirstBrick);
        }
    }

    // Vertex of the cell (a, b, c) counted from brick `b`, -1..6 along each axis; every cell asked for has
    // one.
    std::uint32_t vertex(BrickCoord b, int a, int bb, int c) const {
        if (a < 0) --b.i, a += kBrickCells;
        if (bb < 0) --b.j, bb += kBrickCells;
        if (c < 0) --b.k, c += kBrickCells;
        const BrickSurface& s = surfaces_[index_.get(from_first(b)) - kFirstBrick];
        return s.first_vertex + (s.flat ? 0 : s.cell[static_cast<std::size_t>(cell_index(a, bb, c))]);
    }

  private:
    BrickCoord from_first(BrickCoord b) const { return {b.i - first_.i, b.j - first_.j, b.k - first_.k}; }

    const std::vector<BrickSurface>& surfaces_;
    BrickCoord first_;
    BrickIndex index_;
};

// The polygon around an edge, fanned into at most two triangles; cells that share a vertex have fallen
// together.
void emit(std::array<std::uint32_t, 4> v, bool flip, std::vector<Triangle>& out) {
    if (flip) std::swap(v[1], v[3]);
    if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) out.push_back({v[0], v[1], v[2]});
    if (v[0] != v[2] && v[2] != v[3] && v[3] != v[0]) out.push_back({v[0], v[2], v[3]});
}

std::vector<Triangle> triangles_of(const CarvedField& field, const SurfaceTable& table,
                                   const BrickSurface& s) {
    const BrickContour nodes(field, s.coord);
    std::vector<Triangle> out;
    for (int c = 0; c < kBrickCells; ++c) {
        for (int b = 0; b < kBrickCells; ++b) {
            for (int a = 0; a < kBrickCells; ++a) {
                // Inside a flat brick all polygons shrink to a point: only the edges on its lower faces
                // matter.
                if (s.flat && a > 0 && b > 0 && c > 0) continue;
                const int n = node_index(a, b, c);
                for (int axis = 0; axis < 3; ++axis) {
                    const bool in = nodes.inside(n);
                    if (in == nodes.inside(n + kStep[axis])) continue;
                    int du[3] = {}, dv[3] = {};
                    du[(axis + 1) % 3] = 1;
                    dv[(axis + 2) % 3] = 1;
                    const auto at = [&](int u, int v) {
                        return table.vertex(s.coord, a - u * du[0] - v * dv[0], b - u * du[1] - v * dv[1],
                                            c - u * du[2] - v * dv[2]);
                    };
                    // Counter-clockwise about the axis: the outside is ahead where the edge starts inside.
                    emit({at(0, 0), at(1, 0), at(1, 1), at(0, 1)}, !in, out);
                }
            }
        }
    }
    return out;
}

// The surfaces of the bricks from `first` on up to `last`; their vertices, in order, become the mesh's.
std::vector<BrickSurface> find_surfaces(const CarvedField& field, BrickCoord first, BrickCoord last,
                                        const ParallelFor& parallel, const ContourOptions& options,
                                        TriangleMesh& mesh) {
    const std::vector<BrickCoord> bricks = candidate_bricks(field, first, last);
    std::vector<BrickSurface> found(bricks.size());
    parallel(bricks.size(), [&](std::size_t n) {
        BrickContour brick(field, bricks[n]);
        if (brick.has_surface()) found[n] = brick.surface(options);
    });
    std::erase_if(found, [](const BrickSurface& s) { return s.vertices.empty(); });
    for (BrickSurface& s : found) {
        s.first_vertex = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), s.vertices.begin(), s.vertices.end());
        s.vertices = {};
    }
    return found;
}

// Drops the vertices that no triangle uses.
void drop_unused(TriangleMesh& mesh) {
    constexpr std::uint32_t kUnused = 0xffffffff;
    std::vector<std::uint32_t> renamed(mesh.positions.size(), kUnused);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) renamed[v] = 0;
    }
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < renamed.size(); ++v) {
        if (renamed[v] == kUnused) continue;
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
    const std::vector<BrickSurface> found = find_surfaces(field, {}, field.size(), parallel, options, mesh);
    const SurfaceTable table(found, {}, field.size());
    std::vector<std::vector<Triangle>> parts(found.size());
    parallel(found.size(), [&](std::size_t n) { parts[n] = triangles_of(field, table, found[n]); });
    for (std::vector<Triangle>& part : parts) {
        mesh.triangles.insert(mesh.triangles.end(), part.begin(), part.end());
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
    const std::vector<BrickSurface> found = find_surfaces(field, back, last, serial_for, options, mesh);
    const SurfaceTable table(found, back, last);
    for (const BrickSurface& s : found) {
        if (s.coord.i < first.i || s.coord.j < first.j || s.coord.k < first.k) continue;
        const std::vector<Triangle> part = triangles_of(field, table, s);
        mesh.triangles.insert(mesh.triangles.end(), part.begin(), part.end());
    }
    drop_unused(mesh);
    return mesh;
}

}  // namespace tribo::field
