// SPDX-License-Identifier: MIT
#include "report/picture/raster.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo::report {
namespace {

constexpr int kSubpixel = 256;  // steps of a vertex between two samples

struct FixedPoint {
    std::int64_t x, y;
};

// Twice the area of a, b, p in subpixel units, positive if p is right of a -> b (y points down).
std::int64_t side(FixedPoint a, FixedPoint b, FixedPoint p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// Top-left rule: a sample exactly on a common edge belongs to one of the two triangles.
bool owns_edge(FixedPoint a, FixedPoint b) {
    return b.y < a.y || (b.y == a.y && b.x > a.x);
}

}  // namespace

Buffer::Buffer(int width_samples, int height_samples) : width(width_samples), height(height_samples) {
    const std::size_t samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    nearness.assign(samples, 0);
    triangle.assign(samples, kNothing);
}

// Edge functions on a grid of 1/256 sample are exact in 64 bits, so neighbours have no gaps and no overlaps.
void fill(Buffer& buffer, std::uint32_t triangle, Seen a, Seen b, Seen c) {
    const auto fixed = [](Seen s) {
        return FixedPoint{static_cast<std::int64_t>(std::floor(s.x * kSubpixel + 0.5)),
                          static_cast<std::int64_t>(std::floor(s.y * kSubpixel + 0.5))};
    };
    FixedPoint p[3] = {fixed(a), fixed(b), fixed(c)};
    double depth[3] = {a.nearness, b.nearness, c.nearness};
    std::int64_t area = side(p[0], p[1], p[2]);
    if (area == 0) return;
    if (area < 0) {
        std::swap(p[1], p[2]);
        std::swap(depth[1], depth[2]);
        area = -area;
    }
    // Samples are at half-integer positions.
    const auto first = [](std::int64_t v) { return (v + kSubpixel / 2 - 1) / kSubpixel; };
    const auto last = [](std::int64_t v) { return (v - kSubpixel / 2) / kSubpixel; };
    const auto [x_min, x_max] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [y_min, y_max] = std::minmax({p[0].y, p[1].y, p[2].y});
    const int x0 = static_cast<int>(std::max<std::int64_t>(0, first(x_min)));
    const int x1 = static_cast<int>(std::min<std::int64_t>(buffer.width - 1, last(x_max)));
    const int y0 = static_cast<int>(std::max<std::int64_t>(0, first(y_min)));
    const int y1 = static_cast<int>(std::min<std::int64_t>(buffer.height - 1, last(y_max)));
    if (x0 > x1 || y0 > y1) return;

    const FixedPoint start{std::int64_t{x0} * kSubpixel + kSubpixel / 2,
                           std::int64_t{y0} * kSubpixel + kSubpixel / 2};
    std::int64_t row[3], step_x[3], step_y[3];
    double weight[3];
    for (int i = 0; i < 3; ++i) {
        const FixedPoint from = p[(i + 1) % 3], to = p[(i + 2) % 3];  // the edge opposite to corner i
        row[i] = side(from, to, start) - (owns_edge(from, to) ? 0 : 1);
        step_x[i] = -(to.y - from.y) * kSubpixel;
        step_y[i] = (to.x - from.x) * kSubpixel;
        weight[i] = depth[i] / static_cast<double>(area);
    }
    for (int y = y0; y <= y1; ++y) {
        std::int64_t e[3] = {row[0], row[1], row[2]};
        std::size_t at = buffer.at(x0, y);
        for (int x = x0; x <= x1; ++x, ++at) {
            if ((e[0] | e[1] | e[2]) >= 0) {
                const double d = static_cast<double>(e[0]) * weight[0] +
                                 static_cast<double>(e[1]) * weight[1] +
                                 static_cast<double>(e[2]) * weight[2];
                if (static_cast<float>(d) > buffer.nearness[at]) {
                    buffer.nearness[at] = static_cast<float>(d);
                    buffer.triangle[at] = triangle;
                }
            }
            for (int i = 0; i < 3; ++i) e[i] += step_x[i];
        }
        for (int i = 0; i < 3; ++i) row[i] += step_y[i];
    }
}

}  // namespace tribo::report
