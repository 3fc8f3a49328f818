// SPDX-License-Identifier: MIT
#include "field/shape/shape_overlap.hpp"

#include <algorithm>
#include <array>

namespace tribo::field {
namespace {

// Largest number of waiting boxes. Each halving leaves one, and no box needs more halvings than this to
// become finer than kFinestOverlapMm (2^40 of them to a side).
constexpr std::size_t kMostWaiting = 128;

// A point this far in a solid counts as inside, mm.
constexpr double kInto = 1e-7;

struct Part {
    Box3 box;
    double moving_mm = 0, fixed_mm = 0;  // at its middle, minus the depth
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
    // Distance of the middle of a box from being in both solids. If it is more than the radius of the box,
    // the whole box is outside. The second solid is evaluated only if the first gives no decision.
    const auto measured = [&](const Box3& box) {
        const Vec3 middle = box.centre();
        const double radius = 0.5 * length(box.size());
        const double m = moving.distance_below(middle, radius - depth_mm) + depth_mm;
        return Part{box, m, m >= radius ? m : fixed.distance_below(middle, radius)};
    };
    // Returns the middle, if it is in both. If the middle is deeper in `moving` than it is away from `fixed`,
    // returns the foot point of `fixed` below it. So no thin foil is missed between the middles.
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
        // The nearer half first: then an overlap is found early.
        const Part first = measured(low), second = measured(high);
        wait(first.value() < second.value() ? second : first);
        wait(first.value() < second.value() ? first : second);
    }
    return std::nullopt;
}

}  // namespace tribo::field
