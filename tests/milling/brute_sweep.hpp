// SPDX-License-Identifier: MIT
// The distance to a swept volume by brute force: the tool is tried at very many instants. Knows nothing of
// the formulas of sweeps but the tool's profile.
#pragma once

#include <algorithm>
#include <cmath>

#include "milling/tool/cutter.hpp"
#include "motion/algebra/direction.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {

// To the tool at one instant, mm; at the edge of a flat cutter the larger of the distances to side and
// bottom.
inline double tool_distance(const Cutter& c, const motion::ToolPose& pose, Vec3 p) {
    const Vec3 d = p - pose.tip_mm;
    const double z = dot(d, pose.axis), rho = length(d - z * pose.axis);
    const double corner = c.corner_radius_mm(), side = rho - (c.radius_mm() - corner), under = corner - z;
    double distance = std::max(rho - c.radius_mm(), -z);
    if (corner > 0 && side > 0 && under > 0) distance = std::hypot(side, under) - corner;
    return std::max(distance, z - c.length_mm);
}

// No part of the move brings the point nearer to the tool or farther from it than this per t, mm: the speed
// of the tip, and the turn of the axis times the greatest distance from the tip. Control points bound
// quadratics; those of an axis that turns by at most 0.6 rad are longer than 0.9.
inline double greatest_speed(const motion::Move& m, Vec3 p) {
    double tip = distance(m.start.tip_mm, m.end.tip_mm), turn = motion::angle_rad(m.start.axis, m.end.axis);
    if (m.arc) {
        tip += std::abs(m.arc->turn_rad) * distance(m.start.tip_mm, m.arc->centre_mm);
    }
    if (m.quadratic) {
        const Vec3 tip_control = m.quadratic->tip_control_mm, axis_control = m.quadratic->axis_control;
        tip = 2 * std::max(distance(tip_control, m.start.tip_mm), distance(tip_control, m.end.tip_mm));
        turn = 2 / 0.9 * std::max(distance(axis_control, m.start.axis), distance(axis_control, m.end.axis));
    }
    return tip + turn * (distance(p, m.start.tip_mm) + tip);
}

// The least over all instants, within 3e-6 mm for moves of up to 10 mm and 0.6 rad. First 65 instants; then
// 65 within each gap that the greatest speed lets hold a lesser distance; then golden sections in each valley
// among these. A valley that no sample shows is no deeper than the point's acceleration, less than 40 mm per
// t^2, times the square of the step.
// `distance_at` is the distance from the tool at one pose.
template <class Distance>
double brute_distance(const Distance& distance_at, const motion::Move& m, Vec3 p) {
    constexpr int kGaps = 64, kSections = 40;
    constexpr double kGap = 1.0 / kGaps, kStep = kGap / kGaps, kGolden = 0.6180339887498949;
    const auto at = [&](double t) { return distance_at(motion::pose_at(m, std::clamp(t, 0.0, 1.0)), p); };
    double coarse[kGaps + 1], best = 1e300;
    for (int n = 0; n <= kGaps; ++n) best = std::min(best, coarse[n] = at(n * kGap));
    const double fall = 0.5 * greatest_speed(m, p) * kGap;
    for (int n = 0; n < kGaps; ++n) {
        if (0.5 * (coarse[n] + coarse[n + 1]) - fall >= best) continue;
        double before = at(n * kGap - kStep), here = coarse[n];
        for (int k = 0; k <= kGaps; ++k) {
            const double t = n * kGap + k * kStep, after = at(t + kStep);
            best = std::min(best, here);
            if (here <= before && here <= after) {
                double lo = std::max(t - kStep, 0.0), hi = std::min(t + kStep, 1.0);
                double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo), at_a = at(a), at_b = at(b);
                for (int i = 0; i < kSections; ++i) {
                    best = std::min({best, at_a, at_b});
                    if (at_a < at_b) {
                        hi = b;
                        b = a;
                        at_b = at_a;
                        at_a = at(a = hi - kGolden * (hi - lo));
                    } else {
                        lo = a;
                        a = b;
                        at_a = at_b;
                        at_b = at(b = lo + kGolden * (hi - lo));
                    }
                }
            }
            before = here;
            here = after;
        }
    }
    return best;
}
inline double brute_distance(const Cutter& c, const motion::Move& m, Vec3 p) {
    return brute_distance([&](const motion::ToolPose& pose, Vec3 q) { return tool_distance(c, pose, q); }, m,
                          p);
}

}  // namespace tribo::milling
