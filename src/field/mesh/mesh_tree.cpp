// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_tree.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace tribo::field {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr int kBins = 16;
// Below this depth both halves have equal numbers, so that no mesh makes the tree deeper than the list of the
// search.
constexpr int kMaxUnevenDepth = 32;
constexpr int kMaxDepth = 64;
// A box is skipped only if it is farther than the best by more than any rounding. So a triangle at the same
// distance is never missed, whatever the order of the search.
constexpr double kTie = 1 + 1e-12;

Vec3 wide(const Point3f& p) {
    return {p[0], p[1], p[2]};
}

double axis_gap(double p, float low, float high) {
    const double below = static_cast<double>(low) - p, above = p - static_cast<double>(high);
    return std::max(0.0, std::max(below, above));
}

double half_area(const Box3& box) {
    if (box.empty()) return 0;
    const Vec3 s = box.size();
    return s.x * s.y + s.y * s.z + s.z * s.x;
}

// Seen along z: returns 1 if the edge from `a` to `b` passes the point upwards (in y) on its right (larger
// x), -1 if downwards, else 0. The lower end belongs to the edge, the upper one does not. The arithmetic is
// the same for the edge from `b` to `a`.
int passes(Vec3 p, Vec3 a, Vec3 b) {
    if ((a.y <= p.y) == (b.y <= p.y)) return 0;
    const bool up = a.y <= p.y;
    const Vec3 low = up ? a : b, high = up ? b : a;
    const double left = (high.x - low.x) * (p.y - low.y) - (p.x - low.x) * (high.y - low.y);
    return left > 0 ? (up ? 1 : -1) : 0;
}

// Returns 1 or -1 if the triangle lies above the point and shows its back or its front to it, else 0.
int winding_above(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    const int side = passes(p, a, b) + passes(p, b, c) + passes(p, c, a);
    if (side == 0) return 0;
    const double low = std::min({a.z, b.z, c.z}), high = std::max({a.z, b.z, c.z});
    if (p.z < low) return side;
    const Vec3 n = cross(b - a, c - a);
    // The computed height of a steep triangle is inaccurate, but it lies between the heights of its corners.
    const double z = n.z != 0 ? a.z - (n.x * (p.x - a.x) + n.y * (p.y - a.y)) / n.z : low;
    return p.z < std::clamp(z, low, high) ? side : 0;
}

}  // namespace

TrianglePoint closest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    const auto answer = [&](Vec3 q, TrianglePlace place) {
        return TrianglePoint{q, squared_length(p - q), place};
    };
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return answer(a, TrianglePlace::corner0);
    const Vec3 bp = p - b;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return answer(b, TrianglePlace::corner1);
    const double vc = d1 * d4 - d3 * d2;
    // d1 - d3 is the squared length of the edge. If it is zero, there is no edge.
    if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3)
        return answer(a + d1 / (d1 - d3) * ab, TrianglePlace::edge0);
    const Vec3 cp = p - c;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return answer(c, TrianglePlace::corner2);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6)
        return answer(a + d2 / (d2 - d6) * ac, TrianglePlace::edge2);
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6) {
        return answer(b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), TrianglePlace::edge1);
    }
    const double sum = va + vb + vc;
    return answer(a + vb / sum * ab + vc / sum * ac, TrianglePlace::face);
}

// Splits where the surface area heuristic over sixteen bins is least (Wald 2007).
struct MeshTree::Builder {
    struct Item {
        Box3 box;
        Vec3 centre;
        std::uint32_t triangle;
    };

    MeshTree& tree;
    const TriangleMesh& mesh;
    std::vector<Item> items;

    void build(std::uint32_t first, std::uint32_t count, int depth) {
        Box3 box, centres;
        for (std::uint32_t i = first; i < first + count; ++i) {
            box.include(items[i].box);
            centres.include(items[i].centre);
        }
        const std::size_t node = tree.nodes_.size();
        tree.nodes_.emplace_back();
        for (int axis = 0; axis < 3; ++axis) {  // corners are floats, so nothing is rounded
            tree.nodes_[node].min[static_cast<std::size_t>(axis)] = static_cast<float>(box.min[axis]);
            tree.nodes_[node].max[static_cast<std::size_t>(axis)] = static_cast<float>(box.max[axis]);
        }
        if (count <= kLeafTriangles) {
            tree.nodes_[node].first = static_cast<std::uint32_t>(tree.corners_.size());
            tree.nodes_[node].triangles = count;
            for (std::uint32_t i = first; i < first + count; ++i) add_corners(items[i].triangle);
            return;
        }
        const std::uint32_t left = split(first, count, centres, depth);
        build(first, left, depth + 1);
        tree.nodes_[node].first = static_cast<std::uint32_t>(tree.nodes_.size());
        build(first + left, count - left, depth + 1);
    }

    void add_corners(std::uint32_t triangle) {
        const Triangle& t = mesh.triangles[triangle];
        tree.place_of_[triangle] = static_cast<std::uint32_t>(tree.corners_.size());
        tree.corners_.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], triangle});
    }

    // Orders the items so that the first part goes left; returns the size of this part.
    std::uint32_t split(std::uint32_t first, std::uint32_t count, const Box3& centres, int depth) {
        const Vec3 size = centres.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const auto begin = items.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = begin + static_cast<std::ptrdiff_t>(count);
        if (depth < kMaxUnevenDepth && size[axis] > 0) {
            const double scale = kBins / size[axis];
            const auto bin = [&](const Item& item) {
                return std::min(kBins - 1, static_cast<int>((item.centre[axis] - centres.min[axis]) * scale));
            };
            const int border = cheapest_border(first, count, bin);
            const auto middle =
                std::partition(begin, end, [&](const Item& item) { return bin(item) < border; });
            if (middle != begin && middle != end) return static_cast<std::uint32_t>(middle - begin);
        }
        std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2), end,
                         [&](const Item& a, const Item& b) {
                             return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis]
                                                                     : a.triangle < b.triangle;
                         });
        return count / 2;
    }

    template <class Bin>
    int cheapest_border(std::uint32_t first, std::uint32_t count, const Bin& bin) const {
        std::array<Box3, kBins> boxes;
        std::array<std::uint32_t, kBins> counts{};
        for (std::uint32_t i = first; i < first + count; ++i) {
            const auto b = static_cast<std::size_t>(bin(items[i]));
            boxes[b].include(items[i].box);
            ++counts[b];
        }
        std::array<double, kBins> right_cost{};
        Box3 box;
        std::uint32_t n = 0;
        for (std::size_t b = kBins - 1; b > 0; --b) {
            box.include(boxes[b]);
            n += counts[b];
            right_cost[b] = half_area(box) * n;
        }
        box = {};
        n = 0;
        int best = kBins / 2;
        double best_cost = std::numeric_limits<double>::infinity();
        for (std::size_t b = 1; b < kBins; ++b) {
            box.include(boxes[b - 1]);
            n += counts[b - 1];
            const double cost = half_area(box) * n + right_cost[b];
            if (n > 0 && n < count && cost < best_cost) {
                best_cost = cost;
                best = static_cast<int>(b);
            }
        }
        return best;
    }
};

MeshTree::MeshTree(const TriangleMesh& mesh) {
    assert(!mesh.triangles.empty());
    Builder builder{*this, mesh, {}};
    const auto n = static_cast<std::uint32_t>(mesh.triangles.size());
    builder.items.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        auto& item = builder.items[i];
        for (const std::uint32_t corner : mesh.triangles[i]) item.box.include(mesh.position(corner));
        item.centre = item.box.centre();
        item.triangle = i;
    }
    corners_.reserve(n);
    place_of_.resize(n);
    nodes_.reserve(n);
    builder.build(0, n, 0);
    nodes_.shrink_to_fit();
}

MeshTree::Nearest MeshTree::measure(Vec3 p, const Corners& t) const {
    return {t.triangle, closest_on_triangle(p, wide(t.a), wide(t.b), wide(t.c))};
}

template <class Keeps>
void MeshTree::search(Vec3 p, Nearest& best, const Keeps& keeps) const {
    const auto gap = [&](const Node& n) {
        const double x = axis_gap(p.x, n.min[0], n.max[0]), y = axis_gap(p.y, n.min[1], n.max[1]);
        const double z = axis_gap(p.z, n.min[2], n.max[2]);
        return x * x + y * y + z * z;
    };
    struct Waiting {
        std::uint32_t node;
        double gap;
    };
    std::array<Waiting, kMaxDepth> waiting;
    std::size_t count = 0;
    std::uint32_t at = 0;
    double at_gap = gap(nodes_[0]);
    for (;;) {
        const Node& node = nodes_[at];
        if (at_gap <= best.at.squared_mm2 * kTie) {
            if (node.triangles == 0) {
                const std::uint32_t left = at + 1, right = node.first;
                const double left_gap = gap(nodes_[left]), right_gap = gap(nodes_[right]);
                const bool left_first = left_gap <= right_gap;
                waiting[count++] = left_first ? Waiting{right, right_gap} : Waiting{left, left_gap};
                at = left_first ? left : right;
                at_gap = left_first ? left_gap : right_gap;
                continue;
            }
            for (std::uint32_t i = node.first; i < node.first + node.triangles; ++i) {
                const Nearest found = measure(p, corners_[i]);
                const bool nearer =
                    found.at.squared_mm2 < best.at.squared_mm2 ||
                    (found.at.squared_mm2 == best.at.squared_mm2 && found.triangle < best.triangle);
                if (nearer && keeps(found)) best = found;
            }
        }
        if (count == 0) return;
        at = waiting[--count].node;
        at_gap = waiting[count].gap;
    }
}

void MeshTree::search(Vec3 p, Nearest& best) const {
    search(p, best, [](const Nearest&) { return true; });
}

MeshTree::Nearest MeshTree::nearest(Vec3 point_mm) const {
    Nearest best = measure(point_mm, corners_[0]);
    search(point_mm, best);
    return best;
}

MeshTree::Nearest MeshTree::nearest(Vec3 point_mm, std::uint32_t guess) const {
    Nearest best = measure(point_mm, corners_[place_of_[guess]]);
    search(point_mm, best);
    return best;
}

std::optional<MeshTree::Nearest> MeshTree::nearest_within(Vec3 point_mm, double reach_mm,
                                                          std::uint32_t guess) const {
    const double limit = reach_mm * reach_mm;
    Nearest best = measure(point_mm, corners_[place_of_[guess]]);
    best.at.squared_mm2 = std::min(best.at.squared_mm2, limit);
    search(point_mm, best);
    if (!(best.at.squared_mm2 < limit)) return std::nullopt;
    return best;
}

std::optional<MeshTree::Nearest> MeshTree::nearest_kept(Vec3 point_mm, double reach_mm,
                                                        const Filter& filter) const {
    Nearest best;
    best.at.squared_mm2 = reach_mm * reach_mm;
    search(point_mm, best, [&](const Nearest& place) { return filter.keeps(place); });
    if (!(best.at.squared_mm2 < reach_mm * reach_mm)) return std::nullopt;
    return best;
}

// Visits the triangles of all leaves whose boxes, and the boxes around them, meet what is asked for.
template <class Meets, class Visit>
void MeshTree::walk(const Meets& meets, const Visit& visit) const {
    std::array<std::uint32_t, kMaxDepth> waiting;
    std::size_t count = 0;
    for (std::uint32_t at = 0;;) {
        const Node& node = nodes_[at];
        if (meets(node)) {
            if (node.triangles == 0) {
                waiting[count++] = node.first;
                ++at;
                continue;
            }
            for (std::uint32_t i = node.first; i < node.first + node.triangles; ++i) visit(corners_[i]);
        }
        if (count == 0) return;
        at = waiting[--count];
    }
}

void MeshTree::visit_overlapping(const Box3& box, const std::function<void(std::uint32_t)>& visit) const {
    walk([&](const Node& node) { return box.overlaps({wide(node.min), wide(node.max)}); },
         [&](const Corners& t) {
             Box3 own;
             for (const Point3f& corner : {t.a, t.b, t.c}) own.include(wide(corner));
             if (box.overlaps(own)) visit(t.triangle);
         });
}

int MeshTree::winding(Vec3 p) const {
    int windings = 0;
    walk(
        [&](const Node& node) {
            return axis_gap(p.x, node.min[0], node.max[0]) == 0 &&
                   axis_gap(p.y, node.min[1], node.max[1]) == 0 && p.z <= static_cast<double>(node.max[2]);
        },
        [&](const Corners& t) { windings += winding_above(p, wide(t.a), wide(t.b), wide(t.c)); });
    return windings;
}

Box3 MeshTree::bounds_mm() const {
    return {wide(nodes_[0].min), wide(nodes_[0].max)};
}

std::size_t MeshTree::bytes() const {
    return nodes_.capacity() * sizeof(Node) + corners_.capacity() * sizeof(Corners) +
           place_of_.capacity() * sizeof(std::uint32_t);
}

}  // namespace tribo::field
