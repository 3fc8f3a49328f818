// SPDX-License-Identifier: MIT
#include "field/contour/contour_brick.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "field/contour/contour_corner.hpp"
#include "field/shape/quadric.hpp"

namespace tribo::field {
namespace {

// Usual number of crossings on the lower faces of a flat brick: a plane along two axes.
constexpr std::size_t kFlatEdges = 2 * kLatticeEdge - 1;

// All cells of a row.
constexpr unsigned kAllCells = (1U << kBrickCells) - 1;

constexpr bool is_on_lower_face(int node) {
    return node < kStep[2] || node % kStep[2] < kStep[1] || node % kStep[1] == 0;
}

Vec3 into(const Box3& box, Vec3 p) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::clamp(p[axis], box.min[axis], box.max[axis]);
    return p;
}

class BrickContour {
  public:
    BrickContour(const CarvedField& field, BrickCoord coord, const ContourOptions& options)
        : field_(field),
          coord_(coord),
          options_(options),
          margin_(contour_margin(field)),
          nodes_(field, coord) {}

    BrickSurface surface() {
        BrickSurface s;
        s.coord = coord_;
        if (!nodes_.has_surface()) return s;
        nodes_.find_crossings(options_.rough);
        if (nodes_.list().empty()) return s;
        s.flat = is_plane();
        keep_edges(s);
        if (s.flat) {
            Vec3 mean;
            for (const Crossing& c : nodes_.list()) mean += c.point;
            const Vec3 lo = nodes_.node_mm(0);
            s.vertices.push_back(
                to_float(into(room(lo, kBrickCells), mean / static_cast<double>(nodes_.list().size()))));
            return s;
        }
        s.cell.assign(kCells, BrickSurface::kNone);
        for (int c = 0; c < kBrickCells; ++c) {
            for (int b = 0; b < kBrickCells; ++b) {
                // A cell with all corners on one side has a surface only if an edge is crossed twice.
                unsigned left = nodes_.has_thin() ? kAllCells : nodes_.mixed_cells(b, c);
                for (; left != 0; left &= left - 1) place_vertices(s, std::countr_zero(left), b, c);
            }
        }
        return s;
    }

  private:
    void keep_edges(BrickSurface& s) const {
        s.edges.reserve(s.flat ? kFlatEdges : nodes_.list().size());
        const std::vector<Crossing>& list = nodes_.list();
        const double off = margin_;
        for (std::size_t n = 0; n < list.size(); ++n) {
            const std::uint16_t edge = list[n].edge;
            const int node = edge % kLatticeNodes;
            // Inside a flat brick they are not needed.
            if (s.flat && !is_on_lower_face(node)) continue;
            const auto keep = [&](std::uint8_t ordinal, double along) {
                s.edges.push_back({edge, ordinal, nodes_.inside(node), static_cast<float>(along)});
            };
            const int count = nodes_.crossings(edge / kLatticeNodes, node).count;
            const double first = std::clamp(list[n].along, off, 1 - count * off);
            keep(0, first);
            if (count == 2) keep(1, std::clamp(list[++n].along, first + off, 1 - off));
        }
    }

    // The room of the vertices in some cells along each edge, from node `low` on.
    Box3 room(Vec3 low, int cells) const {
        const double off = margin_ * field_.cell_mm(), size = cells * field_.cell_mm();
        return Box3{low, low + Vec3{size, size, size}}.inflated(-off);
    }

    bool is_plane() const {
        constexpr double kRoughAngle = 1e-3;  // of differences in single precision
        const double most_rad = options_.rough ? kRoughAngle : options_.flat_angle_rad;
        const Crossing& first = nodes_.list().front();
        for (const Crossing& c : nodes_.list()) {
            if (squared_length(c.normal - first.normal) >= most_rad * most_rad ||
                std::abs(dot(c.point - first.point, first.normal)) >= options_.flat_cells * field_.cell_mm())
                return false;
        }
        return true;
    }

    void place_vertices(BrickSurface& s, int a, int b, int c) const {
        const int n = node_index(a, b, c);
        const CellPieces p = find_pieces(nodes_, n);
        if (p.count == 0) return;
        const auto first = static_cast<std::uint16_t>(s.vertices.size());
        const int cell = cell_index(a, b, c);
        s.cell[static_cast<std::size_t>(cell)] = p.count == 1 ? first : BrickSurface::kSeveral;
        if (p.count > 1) {
            BrickSurface::SeveralPieces several;
            several.cell = static_cast<std::uint16_t>(cell);
            for (std::size_t id = 0; id < kMostCrossings; ++id) {
                several.vertex[id / 2][id % 2] =
                    p.at[id] ? static_cast<std::uint16_t>(first + p.piece[id]) : BrickSurface::kNone;
            }
            s.several.push_back(several);
        }
        std::array<Vec3, kMostCrossings> placed;
        for (int piece = 0; piece < p.count; ++piece)
            placed[static_cast<std::size_t>(piece)] = vertex(p, piece, n);
        if (p.count > 1 && !p.simple) part_pieces(p, n, placed);
        for (int piece = 0; piece < p.count; ++piece)
            s.vertices.push_back(to_float(placed[static_cast<std::size_t>(piece)]));
        for (int axis = 0; axis < 3; ++axis) keep_if_crowded(s, n, 3 * cell + axis);
    }

    // Moves the vertices of two pieces back to the middle of their crossings if no plane separates the pieces
    // with their wanted vertices.
    void part_pieces(const CellPieces& p, int node, std::array<Vec3, kMostCrossings>& placed) const {
        std::array<bool, kMostCrossings> back{};
        const double gap = margin_ * field_.cell_mm();
        for (std::size_t i = 0; i < static_cast<std::size_t>(p.count); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (p.are_parted(static_cast<int>(i), placed[i], static_cast<int>(j), placed[j], gap))
                    continue;
                back[i] = back[j] = true;
            }
        }
        for (std::size_t i = 0; i < static_cast<std::size_t>(p.count); ++i) {
            if (back[i]) placed[i] = into(room(nodes_.node_mm(node), 1), p.middle(static_cast<int>(i)));
        }
    }

    void keep_if_crowded(BrickSurface& s, int node, int face) const {
        const int axis = face % 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const int count = nodes_.crossings(u, node).count + nodes_.crossings(v, node).count +
                          nodes_.crossings(u, node + kStep[v]).count +
                          nodes_.crossings(v, node + kStep[u]).count;
        const FaceSegments f = count > 1 ? nodes_.segments(node, axis) : FaceSegments{};
        if (f.count < 2 && !f.has_thin) return;
        BrickSurface::CrowdedFace crowded{static_cast<std::uint16_t>(face), f, {}};
        for (int k = 0; k < f.count; ++k) {
            const FaceSegment& seg = f.all[static_cast<std::size_t>(k)];
            const Lattice lattice = field_.lattice(coord_);
            const Vec3 from = s.on_face(lattice, node, axis, seg.from);
            const Vec3 to = s.on_face(lattice, node, axis, seg.to);
            Vec3 middle = 0.5 * (from + to);
            if (f.count == 1 && seg.from.edge != seg.to.edge) {
                middle = corner_on_face(field_, nodes_.ref(), from, to, axis, nodes_.node_mm(node),
                                        margin_ * field_.cell_mm());
            }
            // Around the end of a wall the segment comes back to the edge from which it starts.
            if (seg.from.edge == seg.to.edge) {
                const int along = seg.from.edge % 2 == 0 ? u : v, into = seg.from.edge % 2 == 0 ? v : u;
                const double sense = seg.from.edge == 0 || seg.from.edge == 3 ? 1 : -1;
                double depth = 0.25 * tribo::distance(from, to);
                // At most half of the distance to the segments around it.
                for (int other = 0; other < f.count; ++other) {
                    const FaceSegment& o = f.all[static_cast<std::size_t>(other)];
                    if (o.from.edge == o.to.edge) continue;
                    const Vec3 p = s.on_face(lattice, node, axis, o.from);
                    const Vec3 q = s.on_face(lattice, node, axis, o.to);
                    for (const Vec3 at : {from, middle, to}) {
                        const double share = (at[along] - p[along]) / (q[along] - p[along]);
                        if (share >= 0 && share <= 1)
                            depth = std::min(depth, 0.5 * sense * (lerp(p, q, share)[into] - at[into]));
                    }
                }
                middle[into] += sense * std::max(depth, 0.0);
            }
            crowded.middle[static_cast<std::size_t>(k)] = to_float(middle);
        }
        s.crowded.push_back(crowded);
    }

    // For a wall or slit that is thinner than a cell and ends in this cell. Its crossings lie on two planes
    // that do not show how far it continues. Returns the farthest point on the way from their middle into the
    // cell that is still in the wall or slit.
    std::optional<Vec3> end_of_wall(const CellPieces& pieces, int piece, Vec3 middle, Vec3 low) const {
        Vec3 across;
        for (std::size_t id = 0; id < kMostCrossings; id += 2) {
            if (!pieces.has(id, piece) || !pieces.comes_back(id)) continue;
            across = pieces.at[id]->normal - pieces.at[id + 1]->normal;
        }
        // Sides that lean together by more than 37 degrees are those of an edge.
        constexpr double kEdge = 1.9;
        if (length(across) < kEdge) return std::nullopt;
        const double half = 0.5 * field_.cell_mm();
        across = normalized(across);
        Vec3 way = low + Vec3{half, half, half} - middle;
        way -= dot(way, across) * across;
        const double reach = 2 * half;
        if (length(way) < 1e-3 * half) return std::nullopt;
        way = normalized(way);
        const auto distance_at = [&](double s) {
            return field_.exact(nodes_.ref(), middle + s * way).distance_mm;
        };
        double in = 0, out = reach;
        const bool wall = distance_at(in) < 0;
        if ((distance_at(out) < 0) == wall) return std::nullopt;
        constexpr int kHalvings = 30;
        for (int n = 0; n < kHalvings; ++n) {
            const double s = 0.5 * (in + out);
            ((distance_at(s) < 0) == wall ? in : out) = s;
        }
        return middle + in * way;
    }

    Vec3 vertex(const CellPieces& pieces, int piece, int node) const {
        Quadric quadric;
        std::array<const Crossing*, kMostCrossings> around;
        std::size_t count = 0;
        for (std::size_t id = 0; id < kMostCrossings; ++id) {
            if (!pieces.has(id, piece)) continue;
            around[count++] = pieces.at[id];
            quadric.add(pieces.at[id]->point, pieces.at[id]->normal);
        }
        const Vec3 lo = nodes_.node_mm(node);
        const Box3 cell = room(lo, 1);
        if (const std::optional<Vec3> end = end_of_wall(pieces, piece, quadric.mean(), lo))
            return into(cell, *end);
        // Several pieces stay apart if each is in the hull of its own crossings.
        if (pieces.count > 1 && pieces.simple) return into(cell, quadric.mean());
        // Planes through the crossings miss a curved surface by their sagitta. Newton steps remove this
        // error: onto the surface where it is smooth, onto the intersection of its faces where it is not.
        constexpr double kSmooth = 0.1;  // rad
        if (options_.rough) {
            if (quadric.is_flat(kSmooth)) return into(cell, quadric.mean());
            const bool at_blank =
                std::any_of(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(count),
                            [](const Crossing* c) { return c->shape == 0; });
            const Vec3 p = quadric.solve_in(cell);
            return at_blank ? into(cell, onto_blank(p)) : p;
        }
        if (quadric.is_flat(kSmooth)) {
            const Vec3 p = into(cell, quadric.mean());
            const CarvedField::Exact e = field_.exact(nodes_.ref(), p);
            const bool near = std::abs(e.distance_mm) < 0.5 * field_.cell_mm();
            return near ? into(cell, p - e.distance_mm * normal_of_face(field_, e.shape, p)) : p;
        }
        Vec3 p = quadric.solve_in(cell);
        Quadric planes;
        for (const double back : {0.3, 0.03}) {
            planes = {};
            for (std::size_t k = 0; k < count; ++k) {
                const FacePoint t = tangent_near(field_, *around[k], p, back);
                planes.add(t.point, t.normal);
            }
            p = planes.solve_in(cell);
        }
        return onto_surface(planes, p, cell);
    }

    // The faces of the blank are flat up to their edges, however rough the rest is.
    Vec3 onto_blank(Vec3 p) const {
        const Shape::Slope s = field_.blank().slope(p);
        constexpr double kNear = 0.1;  // cells
        return std::abs(s.distance_mm) < kNear * field_.cell_mm() ? p - s.distance_mm * s.gradient : p;
    }

    // The planes miss the surface where a face takes part that crosses no edge of the cell, and at cusps of
    // strongly curved faces. First the face at p becomes one of the planes; what is left is a way along its
    // normal.
    Vec3 onto_surface(Quadric planes, Vec3 p, const Box3& cell) const {
        constexpr int kPlanes = 4, kSteps = 8;
        const double close_mm = 1e-3 * field_.cell_mm();
        for (int n = 0; n < kSteps; ++n) {
            const CarvedField::Exact e = field_.exact(nodes_.ref(), p);
            if (std::abs(e.distance_mm) < close_mm) break;
            const Vec3 out = normal_of_face(field_, e.shape, p), foot = p - e.distance_mm * out;
            if (n < kPlanes) planes.add(foot, out);
            p = n < kPlanes ? planes.solve_in(cell) : into(cell, foot);
        }
        return p;
    }

    const CarvedField& field_;
    BrickCoord coord_;
    const ContourOptions& options_;
    double margin_;
    BrickNodes nodes_;
};

}  // namespace

double contour_margin(const CarvedField& field) {
    constexpr double kLeast = 1e-3, kUlps = 8;
    const Box3 box = field.blank().bounds_mm();
    double most = 0;
    for (int axis = 0; axis < 3; ++axis)
        most = std::max({most, std::abs(box.min[axis]), std::abs(box.max[axis])});
    constexpr double kUlp = 0x1p-23;  // float spacing of numbers up to two
    return std::min(0.25, std::max(kLeast, kUlps * kUlp * most / field.cell_mm()));
}

int BrickSurface::crossings(int axis, int node, const EdgePoint*& first) const {
    const auto at = static_cast<std::uint16_t>(kLatticeNodes * axis + node);
    const auto found = std::lower_bound(edges.begin(), edges.end(), at,
                                        [](const EdgePoint& e, std::uint16_t n) { return e.edge < n; });
    int count = 0;
    for (auto e = found; e != edges.end() && e->edge == at; ++e) ++count;
    first = count > 0 ? &*found : nullptr;
    return count;
}

Vec3 edge_point(const Lattice& lattice, const EdgePoint& e) {
    Vec3 p = node_mm(lattice, e.edge % kLatticeNodes);
    p[e.edge / kLatticeNodes] += lattice.cell_mm * static_cast<double>(e.along);
    return p;
}

Vec3 BrickSurface::on_face(const Lattice& lattice, int node, int axis, FaceSegment::End end) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int from = end.edge == 1 ? node + kStep[u] : end.edge == 2 ? node + kStep[v] : node;
    const EdgePoint* first = nullptr;
    crossings(end.edge % 2 == 0 ? u : v, from, first);
    return edge_point(lattice, first[end.ordinal]);
}

BrickSurface find_surface(const CarvedField& field, BrickCoord coord, const ContourOptions& options) {
    return BrickContour(field, coord, options).surface();
}

}  // namespace tribo::field
