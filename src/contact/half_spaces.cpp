// SPDX-License-Identifier: MIT
#include "contact/half_spaces.hpp"

#include <limits>

namespace tribo::contact {
namespace {

// Less than this over a border is rounding, mm.
constexpr double kOnBorder = 1e-9;
// Two normals closer than this (sine squared) have no line in common that means anything.
constexpr double kParallel = 1e-10;

}  // namespace

void HalfSpaces::put(const HalfSpace& h, double alike) {
    for (int n = 0; n < count; ++n) {
        HalfSpace& s = side[static_cast<std::size_t>(n)];
        if (s.piece == h.piece && dot(s.normal, h.normal) > alike) {
            s = h;
            return;
        }
    }
    if (count == kMost) {
        side[0] = side[1];
        side[1] = side[2];
        --count;
    }
    side[static_cast<std::size_t>(count++)] = h;
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
    // A point that is nearest on one border and allowed is nearest of all, and so on.
    if (least < std::numeric_limits<double>::infinity()) return best;
    for (int n = 0; n < count; ++n) {
        const HalfSpace& a = side[static_cast<std::size_t>(n)];
        const HalfSpace& b = side[static_cast<std::size_t>((n + 1) % count)];
        const double c = dot(a.normal, b.normal), sine2 = 1 - c * c;
        if (sine2 < kParallel || count < 2) continue;
        const double u = a.above(y), v = b.above(y);
        offer(y - ((u - c * v) / sine2) * a.normal - ((v - c * u) / sine2) * b.normal);
    }
    if (least < std::numeric_limits<double>::infinity()) return best;
    if (count == 3) {
        const Vec3 bc = cross(side[1].normal, side[2].normal), ca = cross(side[2].normal, side[0].normal),
                   ab = cross(side[0].normal, side[1].normal);
        const double volume = dot(side[0].normal, bc);
        if (volume * volume > kParallel)
            return (side[0].offset * bc + side[1].offset * ca + side[2].offset * ab) / volume;
    }
    const HalfSpace& last = side[static_cast<std::size_t>(count - 1)];
    return y - last.above(y) * last.normal;
}

}  // namespace tribo::contact
