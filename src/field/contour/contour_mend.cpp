// SPDX-License-Identifier: MIT
#include "field/contour/contour_mend.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/sort_unique.hpp"
#include "field/contour/contour_corner.hpp"
#include "field/contour/contour_table.hpp"
#include "field/contour/guarded_mesh.hpp"
#include "field/mesh/mesh_tree.hpp"
#include "field/shape/quadric.hpp"

namespace tribo::field {
namespace {

// Rounds over the places that changed in the one before. First only where the mesh is much too far, by so
// many times: not all changes can be tried.
constexpr double kMuchTooFar = 3;
constexpr int kFirstRounds = 6, kMostRounds = 12;
// At most so many times the given vertices are added. A groove that the grid missed would need many more.
constexpr std::size_t kMostMore = 3;
// At most so many changes are tried: a share of the triangles, and these. A mesh of terraces that are much
// lower than a cell would take more, for most of its triangles.
constexpr double kTriesPerTriangle = 0.02;
constexpr std::size_t kMostTries = 60'000;
// A triangle is measured where its edges, and lines between them, are divided into so many parts.
constexpr int kParts = 4;
// At an edge of the surface less than this share of what is too far tells that the mesh may be: the distance
// there is that from the nearer face.
constexpr double kTells = 0.1;
// A new place is on the surface within this share of what is too far.
constexpr double kPlaced = 0.1;
constexpr int kMostLooks = 8;
// A vertex moves at most so many cells.
constexpr double kMostLift = 2;
// So many vertices move together.
constexpr std::size_t kMostTogether = 8;
// A new vertex is at most so far from the edge that it divides, in its length.
constexpr double kMostAside = 0.7;
// Triangles may first leave the surface by so many times as much, squared, as other changes come after it:
// where vertices stay as many, and where there are more of them. Of the first kind, in the first rounds only:
// else the same edges would flip to and fro.
constexpr double kWorse = 1.2, kWorseFirst = 2;
constexpr int kPatientRounds = 8;
// Shorter edges, as a share of what is too far, are in the way of others: they are taken out where the mesh
// then leaves the surface by at most the second share more.
constexpr double kShort = 0.5, kWorseForShort = 0.1;

Vec3 centre(const Corners& c) {
    return (c[0] + c[1] + c[2]) / 3;
}

// Mends one block of a mesh.
class Mending {
  public:
    Mending(MeshBlock& mesh, const CarvedField& field, double off_mm, std::size_t most_tries, int round)
        : mesh_(mesh),
          active_(mesh.vertices()),
          field_(field),
          off_mm_(off_mm),
          tries_left_(most_tries),
          round_(round) {}

    // Vertices before folds: a vertex that only has to move would be taken out with its fold.
    void run() {
        for (const std::uint32_t v : active_) {
            if (mesh_.is_near_border(v)) touched_.push_back(v);
        }
        for (const std::uint32_t v : active_) merge(v);
        for (const auto step : {&Mending::lift_vertices, &Mending::unfold_triangles, &Mending::mend_edges,
                                &Mending::mend_triangles}) {
            if (tries_left_ > 0) (this->*step)();
        }
    }
    // The vertices of new triangles, and those at which this block could not do all.
    const std::vector<std::uint32_t>& touched() const { return touched_; }
    std::size_t tries_left() const { return tries_left_; }

  private:
    double off(Vec3 p) const { return std::abs(field_.distance_mm(p)); }

    // True for a part of a fold.
    bool faces_in(const Corners& c) const { return dot(twice_area(c), field_.normal(centre(c))) < 0; }

    // The squared distance from the surface, added up over a triangle. A part of a fold counts as if it were
    // a cell away.
    double error(const Corners& c) const {
        double sum = 0;
        for (int i = 0; i <= kParts; ++i) {
            for (int j = 0; i + j <= kParts; ++j) {
                const double mm = off(c[0] + (i * (c[1] - c[0]) + j * (c[2] - c[0])) / kParts);
                sum += mm * mm;
            }
        }
        if (faces_in(c)) sum += kMeasured * field_.cell_mm() * field_.cell_mm();
        return sum * length(twice_area(c));
    }
    static constexpr int kMeasured = (kParts + 1) * (kParts + 2) / 2;

    // Makes a change if the new triangles meet nothing, and their error is at most so many times that of the
    // old ones, and that of triangles which are `worse_mm` off.
    bool attempt(const MeshChange& change, double times = 1, double worse_mm = 0) {
        if (tries_left_ == 0) return false;
        --tries_left_;
        const std::vector<Facet> facets = mesh_.facets(change);
        if (!mesh_.is_free(change, facets)) return false;
        double most = 0, now = 0;
        for (const std::uint32_t t : change.old) most += times * error_of(t);
        for (const Facet& f : facets) most += kMeasured * worse_mm * worse_mm * length(twice_area(f.at));
        std::vector<double> errors;
        for (const Facet& f : facets) {
            errors.push_back(error(f.at));
            now += errors.back();
            if (!(now < most)) return false;
        }
        const std::vector<std::uint32_t> made = mesh_.make(change);
        for (std::size_t n = 0; n < made.size(); ++n) errors_[made[n]] = errors[n];
        for (const Triangle& t : change.now) touched_.insert(touched_.end(), t.begin(), t.end());
        return true;
    }
    // That of a triangle of the mesh, which is measured once.
    double error_of(std::uint32_t t) {
        const auto [at, is_new] = errors_.try_emplace(t, 0);
        if (is_new) at->second = error(mesh_.corners(t));
        return at->second;
    }

    // The place for a vertex at p: where the faces meet that are seen from the points beside it, looked at
    // ever nearer to it; or else the surface below it.
    std::optional<Vec3> place(std::span<const Vec3> beside, Vec3 p) const {
        double share = 1;
        for (int n = 0; n < kMostLooks; ++n, share *= 0.5) {
            Quadric planes;
            for (const Vec3& b : beside) {
                const Vec3 from = lerp(p, b, share);
                const contact::SurfaceSample s = field_.sample(from);
                planes.add(from - s.distance_mm * s.normal, s.normal);
            }
            const Vec3 before = p;
            p = planes.solve();
            if (n > 0 && distance(before, p) < kPlaced * off_mm_ && off(p) < kPlaced * off_mm_) return p;
        }
        return below(p);
    }
    std::optional<Vec3> below(Vec3 p) const { return on_surface(field_, p, kPlaced * off_mm_); }

    std::vector<Vec3> centres(std::span<const std::uint32_t> triangles) const {
        std::vector<Vec3> all;
        for (const std::uint32_t t : triangles) all.push_back(centre(mesh_.corners(t)));
        return all;
    }

    // A fold lies between two layers of the mesh that face out: it goes with one of its vertices or edges.
    void unfold_triangles() {
        std::vector<std::uint32_t> all = triangles_at_active();
        for (const std::uint32_t t : all) {
            if (is_degenerate(mesh_.triangle(t)) || !faces_in(mesh_.corners(t))) continue;
            const Triangle of = mesh_.triangle(t);
            bool done = false;
            for (std::size_t k = 0; k < 3 && !done; ++k) done = flip(of[k], of[(k + 1) % 3]);
            for (std::size_t k = 0; k < 3 && !done; ++k)
                done = mesh_.knows(of[k]) && collapse(of[k], kMostLift * field_.cell_mm(), 0) != kNoVertex;
        }
    }
    std::vector<std::uint32_t> triangles_at_active() const {
        std::vector<std::uint32_t> all;
        for (const std::uint32_t v : active_) {
            const std::vector<std::uint32_t> around = mesh_.around(v);
            all.insert(all.end(), around.begin(), around.end());
        }
        sort_unique(all);
        return all;
    }

    // Takes an edge at a vertex out if it is short.
    void merge(std::uint32_t v) {
        if (!mesh_.knows(v)) return;
        const double short_mm = kShort * off_mm_;
        for (const std::uint32_t w : mesh_.beside(v)) {
            if (distance(mesh_.position(v), mesh_.position(w)) >= short_mm) continue;
            collapse(v, short_mm, kWorseForShort * off_mm_);
            return;
        }
    }

    // Moves a vertex to the first vertex beside it, at most `reach_mm` away, where that makes the mesh no
    // worse. Returns that one; kNoVertex: there is none.
    std::uint32_t collapse(std::uint32_t v, double reach_mm, double worse_mm) {
        if (!mesh_.has_ring(v)) return kNoVertex;
        const std::vector<std::uint32_t> ring = mesh_.beside(v);
        for (const std::uint32_t w : ring) {
            if (!mesh_.knows(w) || distance(mesh_.position(v), mesh_.position(w)) > reach_mm) continue;
            // Only the two vertices across the edge may be beside both of its ends.
            const std::vector<std::uint32_t> beside = mesh_.beside(w);
            const auto both = std::count_if(beside.begin(), beside.end(), [&](std::uint32_t u) {
                return std::binary_search(ring.begin(), ring.end(), u);
            });
            if (both != 2) continue;
            MeshChange change{mesh_.around(v), {}, {}};
            for (const std::uint32_t t : change.old) {
                Triangle now = mesh_.triangle(t);
                std::replace(now.begin(), now.end(), v, w);
                if (!is_degenerate(now)) change.now.push_back(now);
            }
            if (attempt(change, 1, worse_mm)) return w;
        }
        return kNoVertex;
    }

    // The farthest first: what is in the way of the others may be behind them.
    void lift_vertices() {
        std::vector<std::pair<double, std::uint32_t>> far;
        lifts_.clear();
        for (const std::uint32_t v : active_) {
            if (!mesh_.knows(v) || mesh_.around(v).empty()) continue;
            const Vec3 from = mesh_.position(v);
            const double mm = off(from);
            if (mm <= kTells * off_mm_) continue;
            const std::optional<Vec3> to = place(centres(mesh_.around(v)), from);
            if (!to || distance(*to, from) > kMostLift * field_.cell_mm()) continue;
            far.emplace_back(-mm, v);
            lifts_.emplace(v, *to);
        }
        std::sort(far.begin(), far.end());
        for (const auto& [mm, v] : far) lift(v);
    }
    // Moves a vertex, or else together with vertices beside it that are off the surface too.
    void lift(std::uint32_t v) {
        const auto at = lifts_.find(v);
        if (at == lifts_.end() || mesh_.around(v).empty()) return;
        const Vec3 to = at->second;
        std::vector<std::uint32_t> group{v};
        for (std::size_t n = 0; n < group.size() && n < kMostTogether; ++n) {
            for (const std::uint32_t w : mesh_.beside(group[n])) {
                if (lifts_.contains(w) && std::find(group.begin(), group.end(), w) == group.end())
                    group.push_back(w);
            }
        }
        group.resize(std::min(group.size(), kMostTogether));
        for (std::size_t together = 1; together <= group.size(); ++together) {
            if (!move(std::span(group).first(together), 1)) continue;
            for (std::size_t n = 0; n < together; ++n) lifts_.erase(group[n]);
            return;
        }
        if (move(std::span(group).first(1), 0.5)) return;
        const std::uint32_t w = collapse(v, kMostLift * field_.cell_mm(), 0);
        if (w == kNoVertex) return;
        lifts_.erase(v);
        lifts_.erase(w);
        const auto away = [&](std::uint32_t t) {
            const Corners c = mesh_.corners(t);
            return closest_on_triangle(to, c[0], c[1], c[2]).squared_mm2;
        };
        const std::vector<std::uint32_t> around = mesh_.around(w);
        insert(*std::min_element(around.begin(), around.end(),
                                 [&](std::uint32_t a, std::uint32_t b) { return away(a) < away(b); }),
               to);
    }
    // Moves vertices to their places, or a share of the way.
    bool move(std::span<const std::uint32_t> vertices, double share) {
        MeshChange change;
        for (const std::uint32_t v : vertices) {
            const std::vector<std::uint32_t> around = mesh_.around(v);
            change.old.insert(change.old.end(), around.begin(), around.end());
            change.places.push_back({v, to_float(lerp(mesh_.position(v), lifts_.at(v), share))});
        }
        sort_unique(change.old);
        for (const std::uint32_t t : change.old) change.now.push_back(mesh_.triangle(t));
        return attempt(change, round_ < kPatientRounds ? kWorse : 1);
    }
    // Divides a triangle into three.
    bool insert(std::uint32_t triangle, Vec3 at) {
        if (faces_in(mesh_.corners(triangle)) || !mesh_.has_new_vertex()) return false;
        const Triangle& t = mesh_.triangle(triangle);
        const std::uint32_t v = mesh_.new_vertex();
        return attempt({{triangle}, {{t[0], t[1], v}, {t[1], t[2], v}, {t[2], t[0], v}}, {{v, to_float(at)}}},
                       kWorseFirst);
    }

    struct FarEdge {
        double less_mm;
        std::uint32_t from, to;
        auto operator<=>(const FarEdge&) const = default;
    };
    void mend_edges() {
        std::vector<FarEdge> edges;
        for (const std::uint32_t v : active_) {
            if (!mesh_.knows(v)) continue;
            for (const std::uint32_t w : mesh_.beside(v))
                edges.push_back({0, std::min(v, w), std::max(v, w)});
        }
        sort_unique(edges);
        for (FarEdge& e : edges) {
            const Vec3 p = farthest(e.from, e.to);
            const double mm = off(p);
            if (mm > off_mm_ || (mm > kTells * off_mm_ && is_below_edge(e.from, e.to, p))) e.less_mm = -mm;
        }
        std::erase_if(edges, [](const FarEdge& e) { return e.less_mm == 0; });
        std::sort(edges.begin(), edges.end());
        for (const FarEdge& e : edges) {
            if (!flip(e.from, e.to)) split(e.from, e.to, farthest(e.from, e.to));
        }
    }
    // The place on an edge that is farthest from the surface, of its parts; the middle unless another one is
    // much farther.
    Vec3 farthest(std::uint32_t a, std::uint32_t b) const {
        constexpr double kMuch = 1.2;
        const Vec3 from = mesh_.position(std::min(a, b)), to = mesh_.position(std::max(a, b));
        Vec3 most = lerp(from, to, 0.5);
        double most_mm = off(most);
        for (const double share : {0.25, 0.75}) {
            const Vec3 p = lerp(from, to, share);
            if (const double mm = off(p); mm > kMuch * most_mm) most = p, most_mm = mm;
        }
        return most;
    }
    // True if an edge of the surface near p on an edge of the mesh is too far from the triangles there.
    bool is_below_edge(std::uint32_t a, std::uint32_t b, Vec3 p) const {
        const std::vector<std::uint32_t> triangles = mesh_.at_edge(a, b);
        const std::optional<Vec3> to = place(centres(triangles), p);
        return to && std::none_of(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
                   const Corners c = mesh_.corners(t);
                   return closest_on_triangle(*to, c[0], c[1], c[2]).squared_mm2 < off_mm_ * off_mm_;
               });
    }
    bool flip(std::uint32_t a, std::uint32_t b) {
        MeshChange change{mesh_.at_edge(a, b), {}, {}};
        if (change.old.size() != 2) return false;
        const std::uint32_t c = third(change.old[0], a, b), d = third(change.old[1], a, b);
        if (c == d || !mesh_.knows(c) || !mesh_.at_edge(c, d).empty()) return false;
        change.now = {{a, d, c}, {d, b, c}};
        return attempt(change, round_ < kPatientRounds ? kWorse : 1);
    }
    std::uint32_t third(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const {
        const Triangle& t = mesh_.triangle(triangle);
        return *std::find_if(t.begin(), t.end(), [&](std::uint32_t v) { return v != a && v != b; });
    }
    // Divides an edge at the place for its point p.
    bool split(std::uint32_t a, std::uint32_t b, Vec3 p) {
        MeshChange change{mesh_.at_edge(a, b), {}, {}};
        if (change.old.size() != 2 || !mesh_.has_new_vertex()) return false;
        const std::uint32_t v = mesh_.new_vertex();
        for (const std::uint32_t t : change.old) {
            if (faces_in(mesh_.corners(t))) return false;
            Triangle one = mesh_.triangle(t), other = one;
            std::replace(one.begin(), one.end(), a, v);
            std::replace(other.begin(), other.end(), b, v);
            change.now.push_back(one);
            change.now.push_back(other);
        }
        std::vector<Vec3> beside = centres(change.old);
        for (const std::uint32_t end : {a, b}) beside.push_back(lerp(p, mesh_.position(end), 0.5));
        const double most_mm = kMostAside * distance(mesh_.position(a), mesh_.position(b));
        for (const std::optional<Vec3>& to : {place(beside, p), below(p)}) {
            if (!to || distance(*to, p) > most_mm) continue;
            change.places = {{v, to_float(*to)}};
            if (attempt(change, kWorseFirst)) return true;
        }
        return false;
    }
    void mend_triangles() {
        const std::vector<std::uint32_t> all = triangles_at_active();
        for (const std::uint32_t t : all) {
            if (!is_degenerate(mesh_.triangle(t))) mend_triangle(t);
        }
    }
    std::array<Vec3, 4> inside_of(std::uint32_t triangle) const {
        const Corners c = mesh_.corners(triangle);
        const Vec3 middle = centre(c);
        return {middle, lerp(c[0], middle, 0.5), lerp(c[1], middle, 0.5), lerp(c[2], middle, 0.5)};
    }
    // Gives a triangle a vertex at the place for the point inside that is farthest from the surface, or at
    // the place for the middle of an edge.
    void mend_triangle(std::uint32_t t) {
        const std::array<Vec3, 4> inside = inside_of(t);
        const Vec3 far =
            *std::max_element(inside.begin(), inside.end(), [&](Vec3 p, Vec3 q) { return off(p) < off(q); });
        if (!(off(far) > off_mm_)) return;
        if (const std::optional<Vec3> to = place(inside, far); to && insert(t, *to)) return;
        const Triangle of = mesh_.triangle(t);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = of[k], b = of[(k + 1) % 3];
            if (split(a, b, lerp(mesh_.position(a), mesh_.position(b), 0.5))) return;
        }
    }

    MeshBlock& mesh_;
    std::span<const std::uint32_t> active_;  // sorted
    const CarvedField& field_;
    double off_mm_;
    std::size_t tries_left_;
    int round_;
    std::map<std::uint32_t, double> errors_;  // by triangle
    std::map<std::uint32_t, Vec3> lifts_;     // places for vertices that are off the surface
    std::vector<std::uint32_t> touched_;
};

// Mends a mesh at some vertices, where it is off by more than `far_mm`. Returns all that were touched,
// sorted.
std::vector<std::uint32_t> mend_in_rounds(GuardedMesh& mesh, const CarvedField& field, double far_mm,
                                          int rounds, std::vector<std::uint32_t> active,
                                          std::size_t& tries_left, const ParallelFor& parallel) {
    std::vector<std::uint32_t> all = active;
    for (int round = 0; round < rounds && !active.empty() && tries_left > 0; ++round) {
        std::vector<MeshBlock> blocks = mesh.blocks(active, round);
        std::vector<Mending> mendings;
        mendings.reserve(blocks.size());
        for (MeshBlock& block : blocks) {
            const std::size_t tries = tries_left * block.vertices().size() / active.size();
            mendings.emplace_back(block, field, far_mm, tries, round);
        }
        parallel(mendings.size(), [&](std::size_t n) { mendings[n].run(); });
        active.clear();
        tries_left = 0;
        for (const Mending& m : mendings) {
            active.insert(active.end(), m.touched().begin(), m.touched().end());
            tries_left += m.tries_left();
        }
        sort_unique(active);
        all.insert(all.end(), active.begin(), active.end());
        mesh.take_back(blocks);
    }
    sort_unique(all);
    return all;
}

}  // namespace

void mend(TriangleMesh& mesh, const CarvedField& field, double off_mm,
          std::span<const std::uint32_t> vertices, const ParallelFor& parallel) {
    if (vertices.empty()) return;
    std::size_t tries_left =
        kMostTries + static_cast<std::size_t>(kTriesPerTriangle * static_cast<double>(mesh.triangles.size()));
    GuardedMesh guarded(mesh, vertices, field.cell_mm(), std::min(kMostMore * vertices.size(), tries_left));
    std::vector<std::uint32_t> active(vertices.begin(), vertices.end());
    active = mend_in_rounds(guarded, field, kMuchTooFar * off_mm, kFirstRounds, std::move(active), tries_left,
                            parallel);
    mend_in_rounds(guarded, field, off_mm, kMostRounds, std::move(active), tries_left, parallel);
    guarded.drop_unused();
}

}  // namespace tribo::field
