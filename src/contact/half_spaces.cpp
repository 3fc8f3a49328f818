// SPDX-License-Identifier: MIT
#include "contact/half_spaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo::contact {
namespace {

// A smaller distance over a border is rounding, mm.
constexpr double kOnBorder = 1e-8;
// Two normals closer than this (sine squared) have no reliable common line.
constexpr double kParallel = 1e-10;

}  // namespace

void HalfSpaces::put(const HalfSpace& h, double alike) {
    HalfSpace* same = nullptr;
    for (int n = 0; n < count; ++n) {
        HalfSpace& s = side[static_cast<std::size_t>(n)];
        const double likeness = dot(s.normal, h.normal);
        if (s.piece != h.piece || !(likeness > alike)) continue;
        alike = likeness;
        same = &s;
    }
    if (same != nullptr) {
        same->normal = h.normal;
        same->offset = h.offset;
        return;
    }
    if (count == kMost) {
        for (std::size_t n = 1; n < kMost; ++n) side[n - 1] = side[n];
        --count;
    }
    side[static_cast<std::size_t>(count++)] = h;
}

void HalfSpaces::make_room(Vec3 at) {
    if (count < kMost) return;
    const auto deepest =
        std::ranges::min_element(side, {}, [at](const HalfSpace& one) { return one.above(at); });
    std::move(deepest + 1, side.end(), deepest);
    --count;
}

Vec3 HalfSpaces::nearest(Vec3 y) const {
    Vec3 best = y;
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](Vec3 x) {
        for (int n = 0; n < count; ++n) {
            if (side[static_cast<std::size_t>(n)].above(x) > kOnBorder) return;
        }
        const double d = squared_length(x - y);
        if (d < least) {
            least = d;
            best = x;
        }
    };
    offer(y);
    if (least == 0) return y;
    for (int n = 0; n < count; ++n) {
        const HalfSpace& s = side[static_cast<std::size_t>(n)];
        offer(y - s.above(y) * s.normal);
    }
    // A point that is nearest on one border and allowed is the nearest of all; then the same for two borders
    // and for three.
    if (least < std::numeric_limits<double>::infinity()) return best;
    const auto at = [&](int n) -> const HalfSpace& { return side[static_cast<std::size_t>(n)]; };
    for (int i = 0; i < count; ++i) {
        for (int j = i + 1; j < count; ++j) {
            const double c = dot(at(i).normal, at(j).normal), sine2 = 1 - c * c;
            if (sine2 < kParallel) continue;
            const double u = at(i).above(y), v = at(j).above(y);
            offer(y - ((u - c * v) / sine2) * at(i).normal - ((v - c * u) / sine2) * at(j).normal);
        }
    }
    if (least < std::numeric_limits<double>::infinity()) return best;
    for (int i = 0; i < count; ++i) {
        for (int j = i + 1; j < count; ++j) {
            for (int k = j + 1; k < count; ++k) {
                const Vec3 jk = cross(at(j).normal, at(k).normal), ki = cross(at(k).normal, at(i).normal),
                           ij = cross(at(i).normal, at(j).normal);
                const double volume = dot(at(i).normal, jk);
                if (volume * volume < kParallel) continue;
                offer((at(i).offset * jk + at(j).offset * ki + at(k).offset * ij) / volume);
            }
        }
    }
    if (least < std::numeric_limits<double>::infinity()) return best;
    const HalfSpace& last = side[static_cast<std::size_t>(count - 1)];
    return y - last.above(y) * last.normal;
}

HalfSpaces::Edge HalfSpaces::edge_at(Vec3 at) const {
    Edge edge;
    std::size_t holding = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
        if (std::abs(side[n].above(at)) > kOnBorder) continue;
        if (holding == edge.sides.size()) return {};
        edge.sides[holding++] = n;
    }
    if (holding < edge.sides.size()) return {};
    const Vec3 along = cross(side[edge.sides[0]].normal, side[edge.sides[1]].normal);
    if (squared_length(along) < kParallel) return {};
    edge.along = normalized(along);
    return edge;
}

// At the way s along the line the edge is at s^2 aside from it, so that it is on both sides: there the
// distance to y has no rate by s where s (1 + 2 off aside) is the way to the nearest point on the line.
Vec3 HalfSpaces::aside_on_bend(const Edge& edge) const {
    const HalfSpace &a = side[edge.sides[0]], &b = side[edge.sides[1]];
    const double c = dot(a.normal, b.normal), half = 0.5 / (1 - c * c),
                 bend_a = a.beside == b.piece ? a.bend : 0, bend_b = b.beside == a.piece ? b.bend : 0;
    return half * ((c * bend_b - bend_a) * a.normal + (c * bend_a - bend_b) * b.normal);
}

double HalfSpaces::rest_on_bend(Vec3 y, const Edge& edge, Vec3 flat, Vec3 seen) const {
    const Vec3 off = flat - dot(edge.along, flat - seen) * edge.along - y;
    return 1 + 2 * dot(off, aside_on_bend(edge));
}

Vec3 HalfSpaces::nearest_on_bend(Vec3 y, const Edge& edge, Vec3 flat, Vec3 seen) const {
    // An edge that bends about y nearly as a circle does, or more, leads far: a step of some times the way.
    constexpr double kLeastRest = 0.2;
    const double way = dot(edge.along, flat - seen),
                 bent = way / std::max(rest_on_bend(y, edge, flat, seen), kLeastRest);
    return flat + (bent - way) * edge.along + bent * bent * aside_on_bend(edge);
}

HalfSpaces::Cone HalfSpaces::cone_to(Vec3 direction) const {
    Cone best;
    const auto normal = [&](int n) { return side[static_cast<std::size_t>(n)].normal; };
    const auto offer = [&](const Cone& cone) {
        Vec3 rest = direction;
        for (std::size_t n = 0; n < static_cast<std::size_t>(cone.count); ++n) {
            if (!(cone.weight[n] >= 0)) return;
            rest -= cone.weight[n] * normal(cone.index[n]);
        }
        const double miss = length(rest);
        if (miss >= best.miss) return;
        best = cone;
        best.miss = miss;
    };
    for (int i = 0; i < count; ++i) {
        const double u = dot(direction, normal(i));
        offer({{i}, {u}, 1});
        for (int j = i + 1; j < count; ++j) {
            const double v = dot(direction, normal(j)), c = dot(normal(i), normal(j)), sine2 = 1 - c * c;
            if (sine2 < kParallel) continue;
            offer({{i, j}, {(u - c * v) / sine2, (v - c * u) / sine2}, 2});
            for (int k = j + 1; k < count; ++k) {
                const Vec3 ij = cross(normal(i), normal(j)), jk = cross(normal(j), normal(k)),
                           ki = cross(normal(k), normal(i));
                const double volume = dot(normal(i), jk);
                if (volume * volume < kParallel) continue;
                offer(
                    {{i, j, k},
                     {dot(direction, jk) / volume, dot(direction, ki) / volume, dot(direction, ij) / volume},
                     3});
            }
        }
    }
    return best;
}

}  // namespace tribo::contact
