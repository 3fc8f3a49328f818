// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_outside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "field/mesh/cut_triangle.hpp"
#include "field/mesh/mesh_parts.hpp"
#include "field/mesh/triangles_apart.hpp"

namespace tribo::field {
namespace {

// A side of a triangle is looked at this share of the mesh's diagonal beside it, and so many times that from
// its edges.
constexpr double kBeside = 1e-6, kFromEdge = 10;
// For the volume a side is looked at so near that faces which are in one plane but for the rounding of floats
// are told apart; and what rounding makes of nothing. Shares of the mesh's size with its way from the origin.
constexpr double kFinely = 1e-13, kRounding = 1e-15;
// Nearer to the outside than this a point tells no direction, mm.
constexpr double kNoWay = 1e-6;
// A mesh is a tangle if more pairs of triangles have to be tested than this and so many for each triangle, or
// if more of them cross.
constexpr std::size_t kMostPairs = 10'000'000, kPairsEach = 64, kMostSeams = 20'000, kSeamsEach = 2;

// Where a triangle meets a plane, by the heights of its corners over that; nothing if it does not, or in one
// point, or lies in it. Corners within `slack` are on the plane.
std::optional<Segment> on_plane(const Corners& t, const std::array<double, 3>& height, double slack) {
    std::array<Vec3, 3> at;
    std::size_t count = 0;
    for (std::size_t n = 0; n < 3; ++n) {
        const double a = height[n], b = height[(n + 1) % 3];
        if (std::abs(a) <= slack)
            at[count++] = t[n];
        else if (std::abs(b) > slack && (a < 0) != (b < 0))
            at[count++] = lerp(t[n], t[(n + 1) % 3], a / (a - b));
    }
    if (count != 2) return std::nullopt;
    return Segment{at[0], at[1]};
}

std::size_t shared_corners(const Corners& a, const Corners& b) {
    std::size_t count = 0;
    for (const Vec3 p : a) count += std::ranges::count(b, p) > 0 ? 1 : 0;
    return count;
}

// Of two triangles in one plane that share an edge: whether one lies on the other.
bool lies_on(const Corners& a, const Corners& b) {
    const auto rest = [](const Corners& t, const Corners& other) {
        return *std::ranges::find_if(t, [&](Vec3 p) { return std::ranges::count(other, p) == 0; });
    };
    if (shared_corners(a, b) == 3) return true;
    const Vec3 of_a = rest(a, b), of_b = rest(b, a);
    const auto on_edge = std::ranges::find_if(a, [&](Vec3 p) { return p != of_a; });
    const Vec3 from = *on_edge, to = *std::find_if(on_edge + 1, a.end(), [&](Vec3 p) { return p != of_a; });
    return dot(cross(to - from, of_a - from), cross(to - from, of_b - from)) > 0;
}

// Signed heights of the corners of a triangle over the plane of another one.
std::array<double, 3> heights(const Corners& t, Vec3 normal, Vec3 on_plane) {
    return {dot(normal, t[0] - on_plane), dot(normal, t[1] - on_plane), dot(normal, t[2] - on_plane)};
}

// Whether a triangle with these heights comes to the plane at no more than one point.
bool stays_off(const std::array<double, 3>& height, double slack) {
    int above = 0, below = 0;
    for (const double h : height) {
        above += h > slack ? 1 : 0;
        below += h < -slack ? 1 : 0;
    }
    return above + below > 1 && (above == 0 || below == 0);
}

enum class Meeting { none, along_seam, in_one_plane };

// Whether two triangles meet at more than a point or a common edge, and where.
Meeting meeting_of(const Facet& a, const Facet& b, double slack, Segment& seam) {
    const Vec3 of_a = normalized(twice_area(a.at), Vec3{}), of_b = normalized(twice_area(b.at), Vec3{});
    const std::array a_over = heights(a.at, of_b, b.at[0]), b_over = heights(b.at, of_a, a.at[0]);
    if (stays_off(a_over, slack) || stays_off(b_over, slack)) return Meeting::none;
    const bool in_one_plane = std::ranges::all_of(a_over, [slack](double h) { return std::abs(h) <= slack; });
    if (shared_corners(a.at, b.at) >= 2)
        return in_one_plane && lies_on(a.at, b.at) ? Meeting::in_one_plane : Meeting::none;
    if (surely_apart(a, b)) return Meeting::none;
    const auto in_a = on_plane(a.at, a_over, slack), in_b = on_plane(b.at, b_over, slack);
    if (!in_a || !in_b) return in_one_plane ? Meeting::in_one_plane : Meeting::none;
    // Both on the line of the two planes: the common part.
    const Vec3 along = normalized(cross(of_a, of_b), Vec3{});
    const auto ordered = [&](Segment s) {
        if (dot(along, s.to - s.from) < 0) std::swap(s.from, s.to);
        return s;
    };
    const Segment one = ordered(*in_a), other = ordered(*in_b);
    seam = {dot(along, other.from - one.from) > 0 ? other.from : one.from,
            dot(along, other.to - one.to) < 0 ? other.to : one.to};
    return dot(along, seam.to - seam.from) > slack ? Meeting::along_seam : Meeting::none;
}

Facet facet(const TriangleMesh& mesh, std::uint32_t n) {
    return {mesh.triangles[n], corners(mesh, mesh.triangles[n])};
}

// Whether a place in the plane of a triangle is on it.
bool holds(const Corners& t, Vec3 at) {
    const Vec3 normal = twice_area(t);
    for (std::size_t n = 0; n < 3; ++n) {
        if (dot(normal, cross(t[(n + 1) % 3] - t[n], at - t[n])) < 0) return false;
    }
    return true;
}

Box3 box_of(const Corners& t) {
    Box3 box;
    for (const Vec3 p : t) box.include(p);
    return box;
}

double reach_of(const Box3& box) {
    return distance(box.min, box.max) + length(box.centre());
}

}  // namespace

struct MeshOutside::Crossings {
    std::vector<Seam> seams;
    // Where the side of a crossed triangle may change.
    struct Cut {
        std::uint32_t triangle;
        Segment where;
    };
    std::vector<Cut> cuts;
    // Triangles that lie on an earlier one, in one plane.
    struct Covered {
        std::uint32_t triangle, by;
    };
    std::vector<Covered> covered;
};

// Keeps the places of the outside.
class MeshOutside::Outer final : public MeshTree::Filter {
  public:
    Outer(const MeshOutside& outside, const TriangleMesh& mesh, const MeshTree& tree)
        : outside_(outside), mesh_(mesh), tree_(tree) {}
    bool keeps(const MeshTree::Nearest& place) const override {
        Side side = outside_.side_[place.triangle];
        if (side == Side::crossed) side = outside_.side_at(mesh_, tree_, place.triangle, place.at.point_mm);
        return side != Side::within;
    }

  private:
    const MeshOutside& outside_;
    const TriangleMesh& mesh_;
    const MeshTree& tree_;
};

// How a triangle lies at one of its places, seen from so far beside it.
MeshOutside::Side MeshOutside::side_from(const TriangleMesh& mesh, const MeshTree& tree,
                                         std::uint32_t triangle, Vec3 at, double beside_mm) {
    const Vec3 beside = beside_mm * normalized(twice_area(corners(mesh, mesh.triangles[triangle])), Vec3{});
    const bool air_before = tree.winding(at + beside) == 0, air_behind = tree.winding(at - beside) == 0;
    if (air_before == air_behind) return Side::within;
    return air_before ? Side::front : Side::back;
}

// How a triangle lies about one of its places.
MeshOutside::Side MeshOutside::side_at(const TriangleMesh& mesh, const MeshTree& tree, std::uint32_t triangle,
                                       Vec3 at) const {
    const Corners t = corners(mesh, mesh.triangles[triangle]);
    const Vec3 inward = (1.0 / 3) * (t[0] + t[1] + t[2]) - at;
    const double far = length(inward), from_edge = kFromEdge * beside_mm_;
    at += (far > from_edge ? from_edge / far : 1) * inward;
    return side_from(mesh, tree, triangle, at, beside_mm_);
}

// Returns false for a tangle.
bool MeshOutside::find_crossings(const TriangleMesh& mesh, const MeshTree& tree, Crossings& found) {
    const double slack = kRounding * reach_of(tree.bounds_mm());
    const std::size_t most_seams = kMostSeams + kSeamsEach * mesh.triangles.size();
    std::size_t pairs_left = kMostPairs + kPairsEach * mesh.triangles.size();
    const auto cut_by_edges = [&](std::uint32_t triangle, const Facet& other) {
        for (std::size_t n = 0; n < 3; ++n)
            found.cuts.push_back({triangle, {other.at[n], other.at[(n + 1) % 3]}});
    };
    for (std::uint32_t one = 0; one < mesh.triangles.size(); ++one) {
        if (pairs_left == 0 || found.seams.size() > most_seams) return false;
        const Facet a = facet(mesh, one);
        tree.visit_overlapping(box_of(a.at), [&](std::uint32_t other) {
            if (other <= one || pairs_left == 0) return;
            --pairs_left;
            const Facet b = facet(mesh, other);
            Segment seam;
            const Meeting meeting = meeting_of(a, b, slack, seam);
            if (meeting == Meeting::none) return;
            side_[one] = side_[other] = Side::crossed;
            if (meeting == Meeting::along_seam) {
                found.seams.push_back({seam.from, seam.to, {one, other}});
                for (const std::uint32_t n : {one, other}) found.cuts.push_back({n, seam});
            } else {
                cut_by_edges(one, b);
                cut_by_edges(other, a);
                found.covered.push_back({other, one});
            }
        });
    }
    return true;
}

// Of the triangles that are not crossed. Without crossed ones those of a component all lie alike.
void MeshOutside::find_sides(const TriangleMesh& mesh, const MeshTree& tree) {
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    std::size_t components = 0;
    const std::vector<std::uint32_t> component = components_of(mesh, components);
    const auto of = [&](std::uint32_t n) { return component[mesh.triangles[n][0]]; };
    const auto area = [&](std::uint32_t n) { return length(twice_area(corners(mesh, mesh.triangles[n]))); };
    const auto side = [&](std::uint32_t n) {
        const Corners t = corners(mesh, mesh.triangles[n]);
        return side_at(mesh, tree, n, (1.0 / 3) * (t[0] + t[1] + t[2]));
    };
    std::vector<bool> is_crossed(components);
    std::vector<std::uint32_t> largest(components, count);
    for (std::uint32_t n = 0; n < count; ++n) {
        if (side_[n] == Side::crossed) is_crossed[of(n)] = true;
        std::uint32_t& most = largest[of(n)];
        if (most == count || area(n) > area(most)) most = n;
    }
    std::vector<Side> common(components);
    for (std::size_t k = 0; k < components; ++k) {
        if (!is_crossed[k]) common[k] = side(largest[k]);
    }
    for (std::uint32_t n = 0; n < count; ++n) {
        if (side_[n] != Side::crossed) side_[n] = is_crossed[of(n)] ? side(n) : common[of(n)];
    }
}

// By the divergence theorem over what is outside of each triangle. Where triangles lie on each other the
// first one counts.
void MeshOutside::measure(const TriangleMesh& mesh, const MeshTree& tree, Crossings& found) {
    std::ranges::sort(found.cuts, {}, &Crossings::Cut::triangle);
    std::ranges::sort(found.covered, {}, &Crossings::Covered::triangle);
    const auto sign = [](Side side) { return side == Side::front ? 1 : side == Side::back ? -1 : 0; };
    const Vec3 origin = tree.bounds_mm().centre();
    const double fine_mm = kFinely * reach_of(tree.bounds_mm());
    std::vector<Segment> cuts;
    std::vector<std::uint32_t> before;
    auto next = found.cuts.begin();
    auto next_covered = found.covered.begin();
    double sum = 0;
    for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
        const Corners t = corners(mesh, mesh.triangles[n]);
        const Vec3 normal = twice_area(t);
        const double share_of = dot(t[0] - origin, normal) / 6;
        if (side_[n] != Side::crossed) {
            sum += sign(side_[n]) * share_of;
            continue;
        }
        cuts.clear();
        for (; next != found.cuts.end() && next->triangle == n; ++next) cuts.push_back(next->where);
        before.clear();
        for (; next_covered != found.covered.end() && next_covered->triangle == n; ++next_covered)
            before.push_back(next_covered->by);
        const auto outside = [&](Vec3 at) {
            const Side side = side_from(mesh, tree, n, at, fine_mm);
            const bool counts = std::ranges::none_of(
                before, [&](std::uint32_t other) { return holds(corners(mesh, mesh.triangles[other]), at); });
            return counts ? sign(side) : 0;
        };
        sum += share_of * mean_over(t, cuts, outside);
    }
    volume_mm3_ = sum;
}

// Keeps the parts of the seams between crossings with further triangles that have both material and air
// beside them.
void MeshOutside::keep_outer(const TriangleMesh& mesh, const MeshTree& tree, const std::vector<Seam>& seams) {
    TriangleMesh kept;
    std::vector<double> cuts;
    for (const Seam& seam : seams) {
        cuts.assign({0, 1});
        Box3 box;
        box.include(seam.from);
        box.include(seam.to);
        tree.visit_overlapping(box, [&](std::uint32_t n) {
            if (side_[n] != Side::crossed || n == seam.triangles[0] || n == seam.triangles[1]) return;
            const Corners t = corners(mesh, mesh.triangles[n]);
            const Vec3 normal = twice_area(t);
            const double before = dot(normal, seam.from - t[0]), behind = dot(normal, seam.to - t[0]);
            if ((before < 0) != (behind < 0)) cuts.push_back(before / (before - behind));
        });
        std::ranges::sort(cuts);
        const auto normal = [&](int n) {
            return normalized(twice_area(corners(mesh, mesh.triangles[seam.triangles[n]])), Vec3{});
        };
        const Vec3 both = normalized(normal(0) + normal(1)), apart = normalized(normal(0) - normal(1));
        for (std::size_t n = 1; n < cuts.size(); ++n) {
            const Vec3 from = lerp(seam.from, seam.to, cuts[n - 1]), to = lerp(seam.from, seam.to, cuts[n]);
            if (distance(from, to) <= beside_mm_) continue;
            const Vec3 middle = lerp(from, to, 0.5);
            int in_air = 0;
            for (const Vec3 aside : {both, -1 * both, apart, -1 * apart})
                in_air += tree.winding(middle + beside_mm_ * aside) == 0 ? 1 : 0;
            if (in_air == 0 || in_air == 4) continue;
            const auto first = static_cast<std::uint32_t>(kept.positions.size());
            kept.positions.push_back(to_float(from));
            kept.positions.push_back(to_float(to));
            kept.triangles.push_back({first, first + 1, first + 1});
            seam_triangle_.push_back(seam.triangles[0]);
        }
    }
    if (!kept.triangles.empty()) seams_.emplace(kept);
}

std::optional<MeshOutside> MeshOutside::of(const TriangleMesh& mesh, const MeshTree& tree) {
    MeshOutside found;
    const Box3 box = tree.bounds_mm();
    found.beside_mm_ = kBeside * distance(box.min, box.max);
    found.side_.assign(mesh.triangles.size(), Side::front);
    Crossings crossings;
    if (!found.find_crossings(mesh, tree, crossings)) return std::nullopt;
    found.find_sides(mesh, tree);
    if (std::ranges::all_of(found.side_, [](Side s) { return s == Side::front; })) return std::nullopt;
    std::vector<bool> near(mesh.positions.size());
    for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
        if (found.side_[n] != Side::crossed) continue;
        for (const std::uint32_t corner : mesh.triangles[n]) near[corner] = true;
    }
    for (const Triangle& corner : mesh.triangles)
        found.near_crossed_.push_back(near[corner[0]] || near[corner[1]] || near[corner[2]]);
    found.keep_outer(mesh, tree, crossings.seams);
    found.measure(mesh, tree, crossings);
    return found;
}

MeshOutside::Place MeshOutside::nearest(const TriangleMesh& mesh, const MeshTree& tree, Vec3 p) const {
    MeshTree::Nearest best;
    best.at.squared_mm2 = 1e300;
    if (seams_) {
        best = seams_->nearest(p);
        best.triangle = seam_triangle_[best.triangle];
    }
    const auto face = tree.nearest_kept(p, std::sqrt(best.at.squared_mm2), Outer(*this, mesh, tree));
    if (face)
        best = *face;
    else if (!seams_)
        best = tree.nearest(p);  // no place has been told from the others
    const Vec3 way = best.at.point_mm - p;
    const double far = std::sqrt(best.at.squared_mm2);
    if (far > kNoWay) return {best, way / far};
    const Vec3 normal = normalized(twice_area(corners(mesh, mesh.triangles[best.triangle])));
    const bool turned = side_at(mesh, tree, best.triangle, best.at.point_mm) == Side::back;
    return {best, turned ? -1 * normal : normal};
}

}  // namespace tribo::field
