// SPDX-License-Identifier: MIT
#include "field/contour/contour_refine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/sort_unique.hpp"
#include "field/contour/contour.hpp"
#include "field/contour/contour_brick.hpp"
#include "field/contour/contour_corner.hpp"
#include "field/contour/contour_mend.hpp"
#include "field/contour/contour_table.hpp"

namespace tribo::field {
namespace {

// Each time an edge is split, what it leaves the surface by falls to a quarter.
constexpr int kMostTimes = 5;
// An edge is at least this many times as long as what it leaves a surface by that the grid resolves.
constexpr double kLongOverSagitta = 4;
// The sagitta that the normals at the ends of an edge tell may be too small by this factor: at an edge of the
// surface they are means.
constexpr double kNormalsTell = 4;
// Where the normals beside an edge agree like this, it is no edge of the surface.
constexpr double kOneFace = 0.99;
// So far, in its length, an edge may leave a surface that turns by a right angle under it.
constexpr double kMostBend = 0.5;
// A part of a triangle turns by less than the angle with this cosine.
constexpr double kTurns = 0.5;
// A vertex of the mesh is on the surface within this share of a cell.
constexpr double kOff = 1e-3;
// Where a vertex, or a point of an edge in a crowded cell, is off the surface by this share of the sagitta,
// the mesh beside it may be off by more.
constexpr double kLeft = 0.2;
// Where the normals around a vertex have a mean shorter than this, it is on an edge of the surface.
constexpr double kSharp = 0.999;
// A triangle that faces away like this from a corner's normal (cosine) is a fold.
constexpr double kFolds = -0.2;
// A new vertex is on the surface within this share of the sagitta.
constexpr double kOnSurface = 0.1;
constexpr int kMostSteps = 6;
// Edges that one task looks at.
constexpr std::size_t kAtOnce = 512;

// An edge of the mesh, and the third vertices of its two triangles.
struct Edge {
    std::uint32_t from = 0, to = 0;  // from < to
    std::array<std::uint32_t, 2> beside{};
    std::uint32_t middle = kNoVertex;  // the vertex that splits it

    std::pair<std::uint32_t, std::uint32_t> ends() const { return {from, to}; }
};

std::pair<std::uint32_t, std::uint32_t> ends_of(std::uint32_t a, std::uint32_t b) {
    return std::minmax(a, b);
}

class Refinement {
  public:
    Refinement(TriangleMesh& mesh, const CarvedField& field, double sagitta_mm, const ParallelFor& parallel)
        : mesh_(mesh), field_(field), sagitta_mm_(sagitta_mm), parallel_(parallel) {}

    // Returns the vertices at which the mesh still leaves the surface.
    std::vector<std::uint32_t> run() {
        find_normals();
        find_crowded_cells();
        fresh_.assign(mesh_.triangles.size(), 1);
        for (int n = 0; n < kMostTimes; ++n) {
            find_edges();
            if (edges_.empty() || !find_middles()) break;
            split_triangles();
        }
        find_far_triangles();
        sort_unique(left_);
        return std::move(left_);
    }

  private:
    // The normal of a triangle, twice as long as its area is large.
    Vec3 across(Triangle t) const {
        const Vec3 a = mesh_.position(t[0]);
        return cross(mesh_.position(t[1]) - a, mesh_.position(t[2]) - a);
    }

    // Sums of the normals of the triangles around each vertex, weighted by their areas.
    void find_normals() {
        normals_.assign(mesh_.positions.size(), {});
        areas_.assign(mesh_.positions.size(), 0);
        for (const Triangle& t : mesh_.triangles) {
            const Vec3 n = across(t);
            const auto area = static_cast<float>(length(n));
            for (const std::uint32_t v : t) {
                areas_[v] += area;
                for (std::size_t k = 0; k < 3; ++k)
                    normals_[v][k] += static_cast<float>(n[static_cast<int>(k)]);
            }
        }
    }

    bool faces_away(Triangle t) const {
        const Vec3 n = across(t);
        return std::any_of(t.begin(), t.end(),
                           [&](std::uint32_t v) { return dot(n, normal(v)) < kFolds * length(n); });
    }

    // In a cell with much surface the mesh may be folded or miss some of it; vertices between those beside it
    // would let the mesh meet itself. Such are the cells of triangles that face away, and of vertices that
    // are not on the surface.
    void find_crowded_cells() {
        std::vector<std::uint8_t> crowded(mesh_.positions.size()), far(mesh_.positions.size());
        parallel_((crowded.size() + kAtOnce - 1) / kAtOnce, [&](std::size_t task) {
            const std::size_t end = std::min((task + 1) * kAtOnce, crowded.size());
            for (std::size_t v = task * kAtOnce; v < end; ++v) {
                const double off =
                    std::abs(field_.distance_mm(mesh_.position(static_cast<std::uint32_t>(v))));
                crowded[v] = off > kOff * field_.cell_mm() ? 1 : 0;
                far[v] = off > kLeft * sagitta_mm_ ? 1 : 0;
            }
        });
        for (const Triangle& t : mesh_.triangles) {
            if (!faces_away(t)) continue;
            for (const std::uint32_t v : t) crowded[v] = far[v] = 1;
        }
        crowded_.clear();
        for (std::uint32_t v = 0; v < crowded.size(); ++v) {
            if (crowded[v] != 0) crowded_.push_back(key(cell_of(mesh_.position(v))));
            if (far[v] != 0) left_.push_back(v);
        }
        sort_unique(crowded_);
    }
    using CellAt = std::array<std::int64_t, 3>;
    CellAt cell_of(Vec3 p) const {
        const Vec3 q = (p - field_.lattice({}).node(0, 0, 0)) / field_.cell_mm();
        return {std::lround(q.x), std::lround(q.y), std::lround(q.z)};
    }
    static std::uint64_t key(const CellAt& c) {
        constexpr int kBits = 21;
        constexpr std::int64_t kMiddle = std::int64_t{1} << (kBits - 1);
        std::uint64_t k = 0;
        for (const std::int64_t at : c) k = k << kBits | static_cast<std::uint64_t>(at + kMiddle);
        return k;
    }
    // A crowded cell is here or next to it.
    bool is_crowded(Vec3 p) const {
        const CellAt c = cell_of(p);
        for (int n = 0; n < 27 && !crowded_.empty(); ++n) {
            if (std::binary_search(crowded_.begin(), crowded_.end(),
                                   key({c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1})))
                return true;
        }
        return false;
    }

    Vec3 normal(std::uint32_t v) const {
        return normalized({normals_[v][0], normals_[v][1], normals_[v][2]}, {});
    }

    // True if the triangles around a vertex of the first mesh face different ways.
    bool is_sharp(std::uint32_t v) const {
        const Vec3 sum{normals_[v][0], normals_[v][1], normals_[v][2]};
        return v < areas_.size() && length(sum) < kSharp * static_cast<double>(areas_[v]);
    }

    // True unless the normals at the ends show that the edge is straight enough.
    bool may_bend(std::uint32_t a, std::uint32_t b) const {
        const Vec3 way = mesh_.position(b) - mesh_.position(a);
        const double least = kLongOverSagitta * sagitta_mm_;
        if (squared_length(way) < least * least) return false;
        return kNormalsTell * std::abs(dot(normal(b) - normal(a), way)) > 8 * sagitta_mm_;
    }

    // The edges that may bend, of the triangles that are new.
    void find_edges() {
        edges_.clear();
        for (std::size_t n = 0; n < mesh_.triangles.size(); ++n) {
            const Triangle& t = mesh_.triangles[n];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = t[k], b = t[(k + 1) % 3], beside = t[(k + 2) % 3];
                if (fresh_[n] != 0 && may_bend(a, b)) {
                    const auto [from, to] = ends_of(a, b);
                    edges_.push_back({from, to, {beside, kNoVertex}});
                }
            }
        }
        std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
            return std::pair(a.ends(), a.beside[0]) < std::pair(b.ends(), b.beside[0]);
        });
        // An edge of which only one triangle is new was looked at before.
        std::size_t kept = 0;
        for (std::size_t n = 0; n + 1 < edges_.size(); ++n) {
            if (edges_[n].ends() != edges_[n + 1].ends()) continue;
            Edge& e = edges_[kept++] = edges_[n];
            e.beside[1] = edges_[++n].beside[0];
        }
        edges_.resize(kept);
    }

    // The place nearest to `p` where two faces of the surface meet, by the tangent planes beside it, ever
    // nearer: one on the way to each of the points of these faces.
    std::optional<Vec3> meeting(Vec3 p, Vec3 on_one, Vec3 on_other) const {
        double share = 0.5;
        for (int n = 0; n < kMostSteps; ++n, share *= 0.5) {
            const Vec3 by_one = p + share * (on_one - p), by_other = p + share * (on_other - p);
            const contact::SurfaceSample a = field_.sample(by_one), b = field_.sample(by_other);
            const double c = dot(a.normal, b.normal);
            if (std::abs(c) > kOneFace) return std::nullopt;
            const double above_a = a.distance_mm + dot(a.normal, p - by_one),
                         above_b = b.distance_mm + dot(b.normal, p - by_other);
            const Vec3 step = ((above_a - c * above_b) / (1 - c * c)) * a.normal +
                              ((above_b - c * above_a) / (1 - c * c)) * b.normal;
            p -= step;
            if (n > 0 && length(step) < kOnSurface * sagitta_mm_) return p;
        }
        return std::nullopt;
    }

    // The place on the surface for the middle of an edge that is too far from it. Or else the edge is left as
    // it is, too far from the surface or not.
    struct Middle {
        std::optional<Vec3> at;
        bool is_left = false;
    };
    Middle middle_of(const Edge& e) const {
        const Vec3 a = mesh_.position(e.from), b = mesh_.position(e.to), middle = 0.5 * (a + b);
        if (is_crowded(middle)) return {{}, std::abs(field_.distance_mm(middle)) > kLeft * sagitta_mm_};
        const auto centre = [&](std::uint32_t beside) { return (a + b + mesh_.position(beside)) / 3; };
        std::optional<Vec3> at = meeting(middle, centre(e.beside[0]), centre(e.beside[1]));
        if (at && std::abs(field_.distance_mm(*at)) > kOnSurface * sagitta_mm_) at.reset();
        if (!at) at = on_surface(field_, middle, kOnSurface * sagitta_mm_);
        if (!at) return {{}, true};
        const double off = distance(*at, middle);
        if (off <= sagitta_mm_) return {};
        if (off > kMostBend * distance(a, b)) return {{}, true};
        return {at};
    }

    // Keeps the edges that get a new vertex. Returns whether there are any.
    bool find_middles() {
        std::vector<Middle> found(edges_.size());
        parallel_((edges_.size() + kAtOnce - 1) / kAtOnce, [&](std::size_t task) {
            const std::size_t end = std::min((task + 1) * kAtOnce, edges_.size());
            for (std::size_t n = task * kAtOnce; n < end; ++n) found[n] = middle_of(edges_[n]);
        });
        at_end_.assign(mesh_.positions.size(), false);
        first_new_ = static_cast<std::uint32_t>(mesh_.positions.size());
        std::size_t kept = 0;
        for (std::size_t n = 0; n < edges_.size(); ++n) {
            const auto& [at, is_left] = found[n];
            if (is_left) left_.insert(left_.end(), {edges_[n].from, edges_[n].to});
            if (!at) continue;
            Edge& e = edges_[kept++] = edges_[n];
            e.middle = static_cast<std::uint32_t>(mesh_.positions.size());
            mesh_.positions.push_back(to_float(*at));
            normals_.push_back(to_float(field_.normal(*at)));
            at_end_[e.from] = at_end_[e.to] = true;
        }
        edges_.resize(kept);
        return kept > 0;
    }

    Edge* edge(std::uint32_t a, std::uint32_t b) {
        if (!at_end_[a] || !at_end_[b]) return nullptr;
        const auto ends = ends_of(a, b);
        const auto found = std::lower_bound(edges_.begin(), edges_.end(), ends,
                                            [](const Edge& e, const auto& key) { return e.ends() < key; });
        return found != edges_.end() && found->ends() == ends ? &*found : nullptr;
    }

    // What a triangle becomes: itself, or up to four.
    struct Parts {
        std::array<Triangle, 4> all;
        int count = 0;

        void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            all[static_cast<std::size_t>(count++)] = {a, b, c};
        }
    };
    Parts parts_of(Triangle t) {
        std::array<std::uint32_t, 3> on;
        int split = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Edge* e = edge(t[k], t[(k + 1) % 3]);
            on[k] = e ? e->middle : kNoVertex;
            split += on[k] != kNoVertex ? 1 : 0;
        }
        Parts parts;
        if (split == 0) {
            parts.add(t[0], t[1], t[2]);
            return parts;
        }
        // Turned so that the first edge is split, and with two of them the second one too.
        std::size_t k = 0;
        while (on[k] == kNoVertex || (split == 2 && on[(k + 1) % 3] == kNoVertex)) ++k;
        const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = on[k];
        if (split == 1) {
            parts.add(a, ab, c);
            parts.add(ab, b, c);
            return parts;
        }
        const std::uint32_t bc = on[(k + 1) % 3];
        parts.add(ab, b, bc);
        if (split == 3) {
            const std::uint32_t ca = on[(k + 2) % 3];
            parts.add(ab, bc, ca);
            parts.add(a, ab, ca);
            parts.add(ca, bc, c);
        } else if (distance(mesh_.position(ab), mesh_.position(c)) <
                   distance(mesh_.position(bc), mesh_.position(a))) {
            parts.add(a, ab, c);
            parts.add(ab, bc, c);
        } else {
            parts.add(a, ab, bc);
            parts.add(a, bc, c);
        }
        return parts;
    }

    bool turns_over(Triangle t) {
        const Parts parts = parts_of(t);
        const Vec3 before = across(t);
        for (int n = 0; parts.count > 1 && n < parts.count; ++n) {
            const Vec3 now = across(parts.all[static_cast<std::size_t>(n)]);
            if (!(dot(now, before) > kTurns * length(now) * length(before)) ||
                faces_away(parts.all[static_cast<std::size_t>(n)]))
                return true;
        }
        return false;
    }

    // Where a part would be turned over, the mesh would meet itself: such edges stay as they are.
    void keep_from_turning_over() {
        for (bool any = true; any;) {
            any = false;
            for (const Triangle& t : mesh_.triangles) {
                if (!turns_over(t)) continue;
                any = true;
                for (std::size_t k = 0; k < 3; ++k) {
                    Edge* e = edge(t[k], t[(k + 1) % 3]);
                    if (!e || e->middle == kNoVertex) continue;
                    e->middle = kNoVertex;
                    left_.insert(left_.end(), {e->from, e->to});
                }
            }
        }
    }

    // Triangles whose middle, or a quarter of an edge, is too far from the surface although the middles of
    // their edges are not.
    void find_far_triangles() {
        std::vector<std::uint8_t> far(mesh_.triangles.size());
        parallel_((far.size() + kAtOnce - 1) / kAtOnce, [&](std::size_t task) {
            const std::size_t end = std::min((task + 1) * kAtOnce, far.size());
            for (std::size_t n = task * kAtOnce; n < end; ++n) far[n] = is_far(mesh_.triangles[n]) ? 1 : 0;
        });
        for (std::size_t n = 0; n < far.size(); ++n) {
            if (far[n] != 0) left_.insert(left_.end(), mesh_.triangles[n].begin(), mesh_.triangles[n].end());
        }
    }
    bool is_far(const Triangle& t) const {
        const auto far_at = [&](Vec3 p) { return std::abs(field_.distance_mm(p)) > sagitta_mm_; };
        bool bends = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            if (!may_bend(a, b) && !is_sharp(a) && !is_sharp(b)) continue;
            bends = true;
            for (const double share : {0.25, 0.5, 0.75}) {
                if (far_at(lerp(mesh_.position(a), mesh_.position(b), share))) return true;
            }
        }
        return bends && far_at((mesh_.position(t[0]) + mesh_.position(t[1]) + mesh_.position(t[2])) / 3);
    }

    // The vertices of edges that stay whole.
    void drop_unused() {
        std::uint32_t next = first_new_;
        for (Edge& e : edges_) {
            if (e.middle == kNoVertex) continue;
            mesh_.positions[next] = mesh_.positions[e.middle];
            normals_[next] = normals_[e.middle];
            e.middle = next++;
        }
        mesh_.positions.resize(next);
        normals_.resize(next);
    }

    void split_triangles() {
        keep_from_turning_over();
        drop_unused();
        std::fill(fresh_.begin(), fresh_.end(), std::uint8_t{0});
        for (std::size_t n = 0, count = mesh_.triangles.size(); n < count; ++n) {
            const Parts parts = parts_of(mesh_.triangles[n]);
            if (parts.count == 1) continue;
            mesh_.triangles[n] = parts.all[0];
            mesh_.triangles.insert(mesh_.triangles.end(), parts.all.begin() + 1,
                                   parts.all.begin() + parts.count);
            fresh_[n] = 1;
        }
        fresh_.resize(mesh_.triangles.size(), 1);
    }

    TriangleMesh& mesh_;
    const CarvedField& field_;
    double sagitta_mm_;
    const ParallelFor& parallel_;
    std::vector<Point3f> normals_;        // by vertex
    std::vector<float> areas_;            // by vertex of the mesh as it came: twice those of its triangles
    std::vector<std::uint64_t> crowded_;  // cells of the mesh as it came, sorted
    std::vector<std::uint32_t> left_;     // vertices where the mesh is left too far from the surface
    std::vector<std::uint8_t> fresh_;     // by triangle: 1 if its edges are to be looked at
    std::vector<Edge> edges_;             // sorted by their ends
    std::vector<bool> at_end_;            // by vertex: it is the end of one of them
    std::uint32_t first_new_ = 0;         // of their vertices
};

}  // namespace

std::vector<std::uint32_t> refine(TriangleMesh& mesh, const CarvedField& field, double sagitta_mm,
                                  const ParallelFor& parallel) {
    mesh.normals.clear();
    return Refinement(mesh, field, sagitta_mm, parallel).run();
}

TriangleMesh fine_contour(const CarvedField& field, const ParallelFor& parallel) {
    // An edge of the surface may lie a little farther from the mesh than the surface at its sides does.
    constexpr double kSagittaMm = 0.01, kMendedMm = 0.005;
    TriangleMesh mesh = contour(field, parallel);
    const std::vector<std::uint32_t> left = refine(mesh, field, kSagittaMm, parallel);
    mend(mesh, field, kMendedMm, left, parallel);
    return mesh;
}

}  // namespace tribo::field
