// SPDX-License-Identifier: MIT
#include "session/cut/part_in_stock.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text/decimal.hpp"

namespace tribo::session {
namespace {

constexpr double kSpacingShare = 0.01;  // distance between tested points, as a share of the size of the part

// Calls look(p) for points of the triangle, including its corners, at most `longest` apart.
template <class Look>
void for_points_in(Vec3 a, Vec3 b, Vec3 c, double longest, const Look& look) {
    const double edge = std::max({distance(a, b), distance(b, c), distance(c, a)});
    const int n = static_cast<int>(std::ceil(edge / longest));
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) look(a + (i * (b - a) + j * (c - a)) / n);
    }
}

// Rounds to a micrometre.
std::string text_of(double mm) {
    return format_decimal(std::round(mm * 1e3) / 1e3);
}

}  // namespace

std::optional<OutsidePoint> farthest_outside(const TriangleMesh& part, const field::Shape& blank) {
    OutsidePoint farthest{kOutsideMm, {}};
    bool any = false;
    const auto look = [&](Vec3 p) {
        const double d = blank.distance_mm(p);
        if (d <= farthest.mm) return;
        farthest = {d, p};
        any = true;
    };
    const double spacing = kSpacingShare * length(bounds(part).size());
    std::vector<bool> seen(part.positions.size());
    for (const Triangle& t : part.triangles) {
        for (const std::uint32_t corner : t) {
            if (!seen[corner]) look(part.position(corner));
            seen[corner] = true;
        }
        const Vec3 a = part.position(t[0]), b = part.position(t[1]), c = part.position(t[2]);
        if (std::max({distance(a, b), distance(b, c), distance(c, a)}) > spacing)
            for_points_in(a, b, c, spacing, look);
    }
    if (!any) return std::nullopt;
    return farthest;
}

void warn_of_part_outside(const TriangleMesh& part, const field::Shape& blank, const std::string& job,
                          Warnings& warnings) {
    const auto outside = farthest_outside(part, blank);
    if (!outside) return;
    const Vec3 at = outside->at_mm;
    warnings.push_back(
        {job, 0,
         "the designed part stands " + text_of(outside->mm) + " mm out of the stock at (" + text_of(at.x) +
             ", " + text_of(at.y) + ", " + text_of(at.z) +
             ") mm: the stock is too small there, or one of the two has another zero or unit"});
}

}  // namespace tribo::session
