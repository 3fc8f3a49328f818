// SPDX-License-Identifier: MIT
#include "field/contour/contour_polygon.hpp"

#include <cmath>
#include <optional>

namespace tribo::field {
namespace {

double cross2(Vec3 a, Vec3 b) {
    return a.x * b.y - a.y * b.x;
}

// Returns where a triangle that goes around the edge counter-clockwise meets the edge.
std::optional<double> meets(Vec3 a, Vec3 b, Vec3 c) {
    const double wa = cross2(b, c), wb = cross2(c, a), wc = cross2(a, b), sum = wa + wb + wc;
    const double rounding = -1e-12 * std::abs(sum);
    if (!(sum > 0) || wa < rounding || wb < rounding || wc < rounding) return std::nullopt;
    return (wa * a.z + wb * b.z + wc * c.z) / sum;
}

// The diagonal from a to c passes the edge on the side of b; d is the corner opposite to b. Returns where the
// triangles meet the edge if they stay in the tetrahedra.
std::optional<double> stays(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double margin) {
    const double pa = cross2(a, b), pc = cross2(b, c);
    if (!(pa > 0 && pc > 0)) return std::nullopt;
    // Where the diagonal passes through the plane of the edge and b, it must be in their triangle.
    const Vec3 y = lerp(a, c, pa / (pa + pc));
    const double share = (y.x * b.x + y.y * b.y) / (b.x * b.x + b.y * b.y);
    if (!(share > -1e-9 && share < 1 - margin)) return std::nullopt;
    const double height = (y.z - share * b.z) / (1 - share);
    if (!(height > margin && height < 1 - margin)) return std::nullopt;
    const std::optional<double> met = meets(a, c, d);
    if (met && (*met < margin || *met > 1 - margin)) return std::nullopt;
    return met;
}

std::optional<double> along_diagonal(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double margin) {
    return cross2(a, c) >= 0 ? stays(a, b, c, d, margin) : stays(c, d, a, b, margin);
}

}  // namespace

int diagonal_from(std::span<const Vec3, 4> p, double along, double margin) {
    const std::optional<double> zero = along_diagonal(p[0], p[1], p[2], p[3], margin);
    const std::optional<double> one = along_diagonal(p[1], p[2], p[3], p[0], margin);
    if (!zero) return one ? 1 : -1;
    constexpr double kNoCloser = 1e-6;
    return one && std::abs(*one - along) < std::abs(*zero - along) - kNoCloser ? 1 : 0;
}

bool triangle_stays(std::span<const Vec3, 3> p, double margin) {
    const std::optional<double> met = meets(p[0], p[1], p[2]);
    return met && *met > margin && *met < 1 - margin;
}

}  // namespace tribo::field
