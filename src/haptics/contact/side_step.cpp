// SPDX-License-Identifier: MIT
#include "haptics/contact/side_step.hpp"

#include <algorithm>

namespace tribo::haptics {
namespace {

// Bounds of a step per remaining way.
constexpr double kLeastEase = 0.01, kMostEase = 8;

}  // namespace

void SideStep::reset() {
    last_.known = bend_.known = false;
    ease_ = 1;
}

void SideStep::take(Vec3 rest, Vec3 step, bool same, bool smooth) {
    last_ = {rest, step, same};
    if (!smooth) bend_.known = false;
}

void SideStep::learn(Vec3 rest) {
    if (!last_.known) return;
    const Vec3 step = last_.way;
    Vec3 change = last_.rest - rest;
    const double size = squared_length(step), down = dot(step, change);
    if (down > 0) {
        ease_ = std::clamp(down / squared_length(change), kLeastEase, 1.0);
        change += std::max(0.0, 1 / kMostEase - down / size) * step;
    } else {
        // On a bump that the probe is deeper under than its centre there is nothing to settle at: away.
        change = std::max(1 / kMostEase, 0.5 / (bend_.known ? bend_.ease() : 1)) * step;
        ease_ = std::min(1.0, 4 * ease_);
    }
    bend_ = {step, change, true};
    last_.known = false;
}

Vec3 SideStep::on_side(Vec3 rest, Vec3 normal) const {
    if (!bend_.known) return ease_ * rest;
    const double down = dot(bend_.step, bend_.change), share = dot(bend_.step, rest) / down;
    Vec3 step = ease_ * (rest - share * bend_.change);
    step += (share - dot(bend_.change, step) / down) * bend_.step;
    return step - dot(step, normal) * normal;
}

Vec3 SideStep::round_edge(Vec3 rest, std::span<const Vec3> meeting, double press_mm, double radius_mm) const {
    const Vec3 edge = meeting.size() == 2 ? normalized(cross(meeting[0], meeting[1]), Vec3{}) : Vec3{};
    const Vec3 along = dot(rest, edge) * edge, round = rest - along;
    const double size = length(round);
    if (!(size > 0)) return ease_ * along;
    double end_mm = 0;  // of the circle
    for (const Vec3& normal : meeting) end_mm = std::max(end_mm, radius_mm / size * dot(normal, round));
    const double rate = std::max(1 - press_mm / radius_mm, 1 / kMostEase);
    return ease_ * along + std::min(1 / rate, 1 + end_mm / size) * round;
}

}  // namespace tribo::haptics
