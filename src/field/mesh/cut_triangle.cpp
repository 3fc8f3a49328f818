// SPDX-License-Identifier: MIT
#include "field/mesh/cut_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tribo::field {
namespace {

// A segment in the plane of the triangle, from left to right.
struct Line {
    double left, right, low, slope;
    double at(double x) const { return low + slope * (x - left); }
};

// Where lines end and cross, between the ends of the triangle, in order. `lines` by their left ends. An
// upright one bounds no trapezoid from above or below.
std::vector<double> stops(const std::vector<Line>& lines, double left, double right) {
    std::vector<double> found{left, right};
    const auto add = [&](double x) {
        if (x > left && x < right) found.push_back(x);
    };
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Line& a = lines[i];
        add(a.left);
        add(a.right);
        for (std::size_t k = i + 1; k < lines.size() && lines[k].left < a.right; ++k) {
            const Line& b = lines[k];
            if (a.slope == b.slope) continue;
            const double x = b.left + (a.at(b.left) - b.low) / (b.slope - a.slope);
            if (x > b.left && x < std::min(a.right, b.right)) add(x);
        }
    }
    std::ranges::sort(found);
    return found;
}

}  // namespace

double mean_over(const Corners& t, std::span<const Segment> cuts, const std::function<double(Vec3)>& value) {
    const Vec3 normal = twice_area(t);
    const Vec3 across = normalized(t[1] - t[0], Vec3{}), up = cross(normalized(normal, Vec3{}), across);
    if (up == Vec3{}) return 0;
    std::vector<Line> lines;
    const auto add = [&](Vec3 from, Vec3 to) {
        from -= t[0];
        to -= t[0];
        double left = dot(across, from), right = dot(across, to), low = dot(up, from), high = dot(up, to);
        if (left > right) {
            std::swap(left, right);
            std::swap(low, high);
        }
        lines.push_back({left, right, low, left < right ? (high - low) / (right - left) : 0});
    };
    double left = 0, right = 0;
    for (std::size_t n = 0; n < 3; ++n) {
        add(t[n], t[(n + 1) % 3]);
        left = std::min(left, dot(across, t[n] - t[0]));
        right = std::max(right, dot(across, t[n] - t[0]));
    }
    const std::vector<Line> sides = lines;
    for (const Segment& cut : cuts) add(cut.from, cut.to);
    std::ranges::sort(lines, {}, &Line::left);
    const std::vector<double> at = stops(lines, left, right);

    double sum = 0;
    std::vector<Line> here;
    std::vector<double> heights;
    std::size_t next = 0;
    for (std::size_t n = 1; n < at.size(); ++n) {
        const double x = 0.5 * (at[n - 1] + at[n]);
        std::erase_if(here, [x](const Line& line) { return line.right <= x; });
        for (; next < lines.size() && lines[next].left < x; ++next) {
            if (lines[next].right > x) here.push_back(lines[next]);
        }
        double bottom = 1e300, top = -1e300;
        for (const Line& side : sides) {
            if (!(side.left < x && x < side.right)) continue;
            bottom = std::min(bottom, side.at(x));
            top = std::max(top, side.at(x));
        }
        if (!(bottom < top)) continue;
        heights.clear();
        for (const Line& line : here) heights.push_back(std::clamp(line.at(x), bottom, top));
        std::ranges::sort(heights);
        for (std::size_t k = 1; k < heights.size(); ++k) {
            const double area = (at[n] - at[n - 1]) * (heights[k] - heights[k - 1]);
            if (area <= 0) continue;
            const double y = 0.5 * (heights[k - 1] + heights[k]);
            sum += area * value(t[0] + x * across + y * up);
        }
    }
    return sum / (0.5 * length(normal));
}

}  // namespace tribo::field
