// SPDX-License-Identifier: MIT
#include "surface/roughness.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "surface/height.hpp"

namespace tribo::surface {

std::optional<std::vector<double>> height_profile(const contact::DistanceField& field, Vec3 start_mm,
                                                  Vec3 end_mm, Vec3 up, int points, double limit_mm) {
    std::vector<double> heights;
    heights.reserve(static_cast<std::size_t>(points));
    for (int i = 0; i < points; ++i) {
        const auto height = height_over(field, lerp(start_mm, end_mm, (i + 0.5) / points), up, limit_mm);
        if (!height) return std::nullopt;
        heights.push_back(*height);
    }
    return heights;
}

Roughness roughness(std::span<const double> heights_mm) {
    assert(heights_mm.size() >= 5);
    // Least-squares line over x = -1 ... 1, where the sum of x is zero.
    const auto n = static_cast<double>(heights_mm.size());
    const auto x_of = [&](std::size_t i) { return (2 * static_cast<double>(i) + 1) / n - 1; };
    double mean = 0, slope = 0, squares = 0;
    for (std::size_t i = 0; i < heights_mm.size(); ++i) {
        mean += heights_mm[i] / n;
        slope += x_of(i) * heights_mm[i];
        squares += x_of(i) * x_of(i);
    }
    slope /= squares;
    std::vector<double> r(heights_mm.size());
    Roughness result;
    for (std::size_t i = 0; i < r.size(); ++i) {
        r[i] = heights_mm[i] - mean - slope * x_of(i);
        result.ra_mm += std::abs(r[i]) / n;
        result.rq_mm += r[i] * r[i] / n;
    }
    result.rq_mm = std::sqrt(result.rq_mm);
    const auto range = [&](std::size_t from, std::size_t to) {
        const auto [low, high] = std::minmax_element(r.begin() + static_cast<std::ptrdiff_t>(from),
                                                     r.begin() + static_cast<std::ptrdiff_t>(to));
        return *high - *low;
    };
    for (std::size_t fifth = 0; fifth < 5; ++fifth) {
        result.rz_mm += range(fifth * r.size() / 5, (fifth + 1) * r.size() / 5) / 5;
    }
    result.rt_mm = range(0, r.size());
    return result;
}

}  // namespace tribo::surface
