// SPDX-License-Identifier: MIT
#include "field/carved/near_margin.hpp"

#include <algorithm>
#include <span>

#include "field/carved/nearest_places.hpp"

namespace tribo::field {
namespace {

// A place that has moved by no more than this per way of its point is the same one.
constexpr double kKeeps = 2;
constexpr double kFar = 1e30;  // mm

// Whether the nearest place is another one than that of the hint, and not the same that has slid on.
bool has_leapt(const contact::Foot& foot, Vec3 p, const contact::NearHint& hint) {
    // A place slides farther than its point on hollow surface only.
    constexpr double kTurned = 0.9, kSlides = 20;
    const Vec3 before = normalized(hint.from_mm - hint.at_mm, foot.sample.normal);
    return dot(before, foot.sample.normal) < kTurned ||
           distance(foot.at_mm, hint.at_mm) > kSameFoot + kSlides * distance(p, hint.from_mm);
}

}  // namespace

void keep_margin(const contact::Foot& foot, Vec3 p, contact::NearHint& hint) {
    if (hint.sides.count == 0) hint.rest_mm = 0;  // of what, is not known
    if (hint.rest_mm <= 0) return;
    const double moved = distance(p, hint.proved_at_mm), last = distance(hint.from_mm, hint.at_mm);
    const std::span others(hint.other.data(), static_cast<std::size_t>(hint.others));
    const auto nearest_to = [&](Vec3 at) {
        return std::ranges::min_element(others, {},
                                        [at](const auto& one) { return distance(one.at_mm, at); });
    };
    const auto there = nearest_to(foot.at_mm);
    const double there_mm = there == others.end() ? kFar : distance(there->at_mm, foot.at_mm);
    if (there_mm >= distance(foot.at_mm, hint.at_mm) && !has_leapt(foot, p, hint)) return;
    const contact::KnownPlace left{hint.at_mm, hint.sides, last - distance(hint.from_mm, hint.proved_at_mm)};
    const auto same = nearest_to(left.at_mm);
    if (there_mm <= kSameFoot + kKeeps * moved) {
        *there = left;
    } else if (same != others.end() && distance(same->at_mm, left.at_mm) <= kSameFoot) {
        *same = left;
    } else if (others.size() < hint.other.size()) {
        hint.other[static_cast<std::size_t>(hint.others++)] = left;
    } else {
        hint.rest_mm = std::max(0.0, std::min(hint.rest_mm - moved, last - distance(p, hint.from_mm)));
        for (contact::KnownPlace& other : others) other.far_mm -= moved;
        hint.settled_mm -= moved;
        hint.proved_at_mm = p;
    }
}

bool is_nearer_than_rest(const contact::Foot& foot, Vec3 p, const contact::NearHint& hint) {
    const double moved = distance(p, hint.proved_at_mm);
    return hint.rest_mm > 0 && moved < hint.settled_mm && foot.found &&
           foot.sample.distance_mm <= distance(p, hint.at_mm) + kSameDistance &&
           foot.sample.distance_mm - (hint.rest_mm - moved) <= kSameDistance;
}

bool is_nearer_than_others(const contact::Foot& foot, Vec3 p, const contact::NearHint& hint) {
    const double moved = distance(p, hint.proved_at_mm);
    const std::span others(hint.other.data(), static_cast<std::size_t>(hint.others));
    return std::ranges::all_of(others, [&](const contact::KnownPlace& other) {
        return foot.sample.distance_mm - (other.far_mm - moved) <= kSameDistance;
    });
}

}  // namespace tribo::field
