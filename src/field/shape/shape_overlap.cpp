// SPDX-License-Identifier: MIT
#include "field/shape/shape_overlap.hpp"

#include <algorithm>
#include <array>

namespace tribo::field {
namespace {

// Boxes that wait at once: each halving leaves one, and no box is halved more often than this until it is
// finer than kFinestOverlapMm (2^40 of them to a side).
constexpr std::size_t kMostWaiting = 128;

// So far into a solid is inside it, mm.
constexpr double kInto = 1e-7;

struct Part {
    Box3 box;
    double moving_mm = 0, fixed_mm = 0;  // at its middle, less the depth
    double value() const { return std::max(moving_mm, fixed_mm); }
};

}  // namespace

std::optional<Vec3> shared_place(const Shape& moving, const Shape& fixed, double depth_mm) {
    const Box3 a = moving.bounds_mm().inflated(-depth_mm), b = fixed.bounds_mm();
    Box3 both;
    for (int axis = 0; axis < 3; ++axis) {
        both.min[axis] = std::max(a.min[axis], b.min[axis]);
        both.max[axis] = std::min(a.max[axis], b.max[axis]);
        if (!(both.min[axis] < both.max[axis])) return std::nullopt;
    }
    // How far the middle of a box is from being in both; what is more than its radius is too far for all of
    // it. The second solid is asked only where the first leaves doubt.
    const auto measured = [&](const Box3& box) {
        const Vec3 middle = box.centre();
        const double radius = 0.5 * length(box.size());
        const double m = moving.distance_below(middle, radius - depth_mm) + depth_mm;
        return Part{box, m, m >= radius ? m : fixed.distance_below(middle, radius)};
    };
    // The middle, or where it stands deeper in `moving` than it is away from `fixed`, the point of that below
    // it: so no foil slips between the middles.
    const auto place_in = [&](const Part& part) -> std::optional<Vec3> {
        const Vec3 middle = part.box.centre();
        if (part.value() < 0) return middle;
        if (!(part.moving_mm + part.fixed_mm < 0)) return std::nullopt;
        const Vec3 below = middle - (part.fixed_mm + kInto) * fixed.gradient(middle);
        if (!(fixed.distance_mm(below) < 0 && moving.distance_mm(below) < -depth_mm)) return std::nullopt;
        return below;
    };
    std::array<Part, kMostWaiting> waiting;
    std::size_t count = 0;
    const auto wait = [&](const Part& part) {
        if (part.value() < 0.5 * length(part.box.size())) waiting[count++] = part;
    };
    wait(measured(both));
    while (count > 0) {
        const Part part = waiting[--count];
        if (const auto place = place_in(part)) return place;
        if (0.5 * length(part.box.size()) <= kFinestOverlapMm) continue;
        const Vec3 size = part.box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        Box3 low = part.box, high = part.box;
        low.max[axis] = high.min[axis] = part.box.centre()[axis];
        // The nearer half first: where there is an overlap it is found at once.
        const Part first = measured(low), second = measured(high);
        wait(first.value() < second.value() ? second : first);
        wait(first.value() < second.value() ? first : second);
    }
    return std::nullopt;
}

}  // namespace tribo::field
