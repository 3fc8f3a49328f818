// SPDX-License-Identifier: MIT
// Whether a triangle mesh meets itself: exact, because the signs of volumes are (Shewchuk 1997: a bound on
// the rounding of the plain formula decides nearly always, sums that keep all digits decide the rest).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <numeric>
#include <utility>
#include <vector>

#include "base/mesh.hpp"

namespace tribo::test {

inline int sign(double v) {
    return v > 0 ? 1 : v < 0 ? -1 : 0;
}

// A number as a sum of doubles that do not overlap, smallest first: sums and products of such are exact.
class Expansion {
  public:
    Expansion() = default;
    static Expansion difference(float a, float b) {
        Expansion e;
        e.add(double{a});
        e.add(-double{b});
        return e;
    }
    void add(double v) {
        std::size_t kept = 0;
        for (std::size_t n = 0; n < size_; ++n) {
            const double sum = v + part_[n], from_v = sum - part_[n], from_part = sum - from_v;
            const double rest = (v - from_v) + (part_[n] - from_part);
            v = sum;
            if (rest != 0) part_[kept++] = rest;
        }
        if (v != 0) part_[kept++] = v;
        size_ = kept;
    }
    void add(const Expansion& e, double times = 1) {
        for (std::size_t n = 0; n < e.size_; ++n) add(times * e.part_[n]);
    }
    Expansion operator*(const Expansion& o) const {
        Expansion product;
        for (std::size_t n = 0; n < size_; ++n) {
            for (std::size_t m = 0; m < o.size_; ++m) {
                const double p = part_[n] * o.part_[m];
                product.add(std::fma(part_[n], o.part_[m], -p));
                product.add(p);
            }
        }
        return product;
    }
    int sign() const { return size_ == 0 ? 0 : part_[size_ - 1] > 0 ? 1 : -1; }

  private:
    std::array<double, 256> part_;
    std::size_t size_ = 0;
};

// Sign of the volume of a tetrahedron with corners in single precision.
inline int orient3(const Point3f& a, const Point3f& b, const Point3f& c, const Point3f& d) {
    // In one plane across an axis: exact and quick for what is cut along the axes.
    for (std::size_t n = 0; n < 3; ++n) {
        if (b[n] == a[n] && c[n] == a[n] && d[n] == a[n]) return 0;
    }
    double m[3][3], most = 1;
    for (std::size_t n = 0; n < 3; ++n) {
        double largest = 0;
        for (const auto& [row, p] : {std::pair{0, &b}, {1, &c}, {2, &d}}) {
            m[row][n] = double{(*p)[n]} - double{a[n]};
            largest = std::max(largest, std::abs(m[row][n]));
        }
        most *= largest;
    }
    const double plain = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    if (std::abs(plain) > 1e-14 * most) return sign(plain);
    Expansion volume;
    const Point3f* rows[3] = {&b, &c, &d};
    for (std::size_t n = 0; n < 3; ++n) {
        const auto off = [&](std::size_t row, std::size_t column) {
            return Expansion::difference((*rows[row])[column % 3], a[column % 3]);
        };
        Expansion minor = off(1, n + 1) * off(2, n + 2);
        minor.add(off(1, n + 2) * off(2, n + 1), -1);
        volume.add(off(0, n) * minor);
    }
    return volume.sign();
}

// Sign of the area of a triangle seen along an axis.
inline int orient2(const Point3f& a, const Point3f& b, const Point3f& c, std::size_t axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double bu = double{b[u]} - double{a[u]}, bv = double{b[v]} - double{a[v]};
    const double cu = double{c[u]} - double{a[u]}, cv = double{c[v]} - double{a[v]};
    if ((bu == 0 && cu == 0) || (bv == 0 && cv == 0)) return 0;
    const double left = bu * cv, right = bv * cu;
    if (std::abs(left - right) > 1e-14 * (std::abs(left) + std::abs(right))) return sign(left - right);
    Expansion area = Expansion::difference(b[u], a[u]) * Expansion::difference(c[v], a[v]);
    area.add(Expansion::difference(b[v], a[v]) * Expansion::difference(c[u], a[u]), -1);
    return area.sign();
}

using Corners = std::array<Point3f, 3>;

// An axis along which a triangle is seen with an area; 3: it has none.
inline std::size_t seen_along(const Corners& t) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (orient2(t[0], t[1], t[2], axis) != 0) return axis;
    }
    return 3;
}

inline bool in_triangle(const Corners& t, const Point3f& p, std::size_t axis) {
    const int turn = orient2(t[0], t[1], t[2], axis);
    for (std::size_t n = 0; n < 3; ++n) {
        if (orient2(t[n], t[(n + 1) % 3], p, axis) * turn < 0) return false;
    }
    return true;
}

inline bool segments_meet(const Point3f& a, const Point3f& b, const Point3f& c, const Point3f& d,
                          std::size_t axis) {
    const int c_side = orient2(a, b, c, axis), d_side = orient2(a, b, d, axis);
    const int a_side = orient2(c, d, a, axis), b_side = orient2(c, d, b, axis);
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    const auto on = [&](const Point3f& p, const Point3f& q, const Point3f& r, int side) {
        if (side != 0) return false;
        for (std::size_t n = 0; n < 3; ++n) {
            if (r[n] < std::min(p[n], q[n]) || r[n] > std::max(p[n], q[n])) return false;
        }
        return true;
    };
    return on(a, b, c, c_side) || on(a, b, d, d_side) || on(c, d, a, a_side) || on(c, d, b, b_side);
}

// A closed segment and a closed triangle with an area.
inline bool segment_meets(const Point3f& p, const Point3f& q, const Corners& t) {
    const int p_side = orient3(t[0], t[1], t[2], p), q_side = orient3(t[0], t[1], t[2], q);
    if (p_side * q_side > 0) return false;
    if (p_side == 0 && q_side == 0) {
        const std::size_t axis = seen_along(t);
        if (in_triangle(t, p, axis) || in_triangle(t, q, axis)) return true;
        for (std::size_t n = 0; n < 3; ++n) {
            if (segments_meet(p, q, t[n], t[(n + 1) % 3], axis)) return true;
        }
        return false;
    }
    int turn[3];
    for (std::size_t n = 0; n < 3; ++n) turn[n] = orient3(p, q, t[n], t[(n + 1) % 3]);
    const auto all = [&](int s) { return turn[0] * s >= 0 && turn[1] * s >= 0 && turn[2] * s >= 0; };
    return all(1) || all(-1);
}

// Whether all corners of a triangle lie on one side of the plane of another one, and none on it.
inline bool is_beside_plane(const Corners& t, const Corners& plane) {
    const int side = orient3(plane[0], plane[1], plane[2], t[0]);
    return side != 0 && orient3(plane[0], plane[1], plane[2], t[1]) == side &&
           orient3(plane[0], plane[1], plane[2], t[2]) == side;
}

// Whether all corners of a triangle lie beyond one edge of another one in its plane, and none on it.
inline bool is_beyond_an_edge(const Corners& t, const Corners& of, std::size_t axis) {
    const int turn = orient2(of[0], of[1], of[2], axis);
    for (std::size_t n = 0; n < 3; ++n) {
        const Point3f &a = of[n], &b = of[(n + 1) % 3];
        if (std::all_of(t.begin(), t.end(),
                        [&](const Point3f& p) { return orient2(a, b, p, axis) * turn < 0; }))
            return true;
    }
    return false;
}

// Whether closed triangles without a common corner meet.
inline bool meet_apart(const Corners& s, const Corners& t) {
    if (is_beside_plane(t, s) || is_beside_plane(s, t)) return false;
    const std::size_t axis = seen_along(s);
    if (std::all_of(t.begin(), t.end(), [&](const Point3f& p) { return orient3(s[0], s[1], s[2], p) == 0; }))
        return !is_beyond_an_edge(t, s, axis) && !is_beyond_an_edge(s, t, axis);
    for (std::size_t n = 0; n < 3; ++n) {
        if (segment_meets(s[n], s[(n + 1) % 3], t) || segment_meets(t[n], t[(n + 1) % 3], s)) return true;
    }
    return false;
}

// Whether two triangles have more in common than the corners that they share (by value).
inline bool meet(const Corners& s, const Corners& t) {
    std::array<int, 3> twin{-1, -1, -1};
    int shared = 0;
    for (std::size_t n = 0; n < 3; ++n) {
        for (std::size_t m = 0; m < 3; ++m) {
            if (s[n] == t[m]) {
                twin[n] = static_cast<int>(m);
                ++shared;
            }
        }
    }
    const auto edge_of = [](const Corners& c, std::size_t n) {
        return std::array<Point3f, 2>{c[n], c[(n + 1) % 3]};
    };
    if (shared == 3) return true;
    if (shared == 2) {
        std::size_t own = 0, other = 0;
        for (std::size_t n = 0; n < 3; ++n) {
            if (twin[n] < 0) own = n;
            if (std::find(twin.begin(), twin.end(), static_cast<int>(n)) == twin.end()) other = n;
        }
        if (orient3(s[0], s[1], s[2], t[other]) != 0) return false;
        const std::size_t axis = seen_along(s);
        const Point3f &a = s[(own + 1) % 3], &b = s[(own + 2) % 3];
        return orient2(a, b, s[own], axis) == orient2(a, b, t[other], axis);
    }
    if (shared == 1) {
        for (std::size_t n = 0; n < 3; ++n) {
            if (twin[n] < 0) continue;
            const auto a = edge_of(s, (n + 1) % 3),
                       b = edge_of(t, (static_cast<std::size_t>(twin[n]) + 1) % 3);
            return segment_meets(a[0], a[1], t) || segment_meets(b[0], b[1], s);
        }
    }
    return meet_apart(s, t);
}

// Pairs of triangles that meet, and triangles without area: (n, n).
class SelfIntersections {
  public:
    explicit SelfIntersections(const TriangleMesh& mesh) {
        for (const Triangle& t : mesh.triangles) {
            Box box;
            corners_.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
            for (const Point3f& p : corners_.back()) box.include(p);
            boxes_.push_back(box);
        }
        order_.resize(corners_.size());
        std::iota(order_.begin(), order_.end(), 0U);
        for (std::uint32_t n = 0; n < corners_.size(); ++n) {
            if (seen_along(corners_[n]) == 3) pairs_.emplace_back(n, n);
        }
        if (pairs_.empty() && !order_.empty()) {
            build(0, order_.size());
            within(0);
        }
    }
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs() const { return pairs_; }

  private:
    struct Box {
        Point3f min{INFINITY, INFINITY, INFINITY}, max{-INFINITY, -INFINITY, -INFINITY};
        void include(const Point3f& p) {
            for (std::size_t n = 0; n < 3; ++n) {
                min[n] = std::min(min[n], p[n]);
                max[n] = std::max(max[n], p[n]);
            }
        }
        bool meets(const Box& o) const {
            for (std::size_t n = 0; n < 3; ++n) {
                if (min[n] > o.max[n] || o.min[n] > max[n]) return false;
            }
            return true;
        }
    };
    struct Node {
        Box box;
        std::size_t first, last, left = 0, right = 0;
    };
    static constexpr std::size_t kLeaf = 4;

    std::size_t build(std::size_t first, std::size_t last) {
        const std::size_t at = nodes_.size();
        nodes_.push_back({{}, first, last});
        Box box;
        for (std::size_t n = first; n < last; ++n) {
            box.include(boxes_[order_[n]].min);
            box.include(boxes_[order_[n]].max);
        }
        nodes_[at].box = box;
        if (last - first <= kLeaf) return at;
        std::size_t axis = 0;
        for (std::size_t n = 1; n < 3; ++n) {
            if (box.max[n] - box.min[n] > box.max[axis] - box.min[axis]) axis = n;
        }
        const std::size_t middle = (first + last) / 2;
        const auto begin = order_.begin();
        std::nth_element(
            begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
            begin + static_cast<std::ptrdiff_t>(last), [&](std::uint32_t a, std::uint32_t b) {
                return boxes_[a].min[axis] + boxes_[a].max[axis] < boxes_[b].min[axis] + boxes_[b].max[axis];
            });
        const std::size_t left = build(first, middle);
        const std::size_t right = build(middle, last);
        nodes_[at].left = left;
        nodes_[at].right = right;
        return at;
    }
    void look(std::uint32_t a, std::uint32_t b) {
        if (boxes_[a].meets(boxes_[b]) && meet(corners_[a], corners_[b])) pairs_.emplace_back(a, b);
    }
    void within(std::size_t at) {
        const Node& n = nodes_[at];
        if (n.left == 0) {
            for (std::size_t a = n.first; a < n.last; ++a) {
                for (std::size_t b = a + 1; b < n.last; ++b) look(order_[a], order_[b]);
            }
            return;
        }
        within(n.left);
        within(n.right);
        between(n.left, n.right);
    }
    void between(std::size_t s, std::size_t t) {
        const Node &a = nodes_[s], &b = nodes_[t];
        if (!a.box.meets(b.box)) return;
        if (a.left == 0 && b.left == 0) {
            for (std::size_t n = a.first; n < a.last; ++n) {
                for (std::size_t m = b.first; m < b.last; ++m) look(order_[n], order_[m]);
            }
        } else if (b.left == 0 || (a.left != 0 && a.last - a.first >= b.last - b.first)) {
            between(a.left, t);
            between(a.right, t);
        } else {
            between(s, b.left);
            between(s, b.right);
        }
    }

    std::vector<Corners> corners_;
    std::vector<Box> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
};

inline void expect_solid(const TriangleMesh& mesh) {
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_EQ(SelfIntersections(mesh).pairs().size(), 0U);
}

}  // namespace tribo::test
