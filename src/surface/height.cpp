// SPDX-License-Identifier: MIT
#include "surface/height.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::surface {
namespace {

constexpr double kClose = 1e-7;  // a field value that counts as the surface itself, mm
constexpr double kStep = 1e-4;   // least step, mm: it may pass a border seen edge-on; the search goes back

// Returns where the field changes sign between `from` and `to`; `to` is beyond the border. False position
// with halving (Illinois): fast where the field is smooth, safe at cusps.
double refine(const contact::DistanceField& field, Vec3 foot, Vec3 up, double from, double value_from,
              double to, double value_to) {
    for (int i = 0; i < 60 && std::abs(to - from) > kClose; ++i) {
        const double t = (from * value_to - to * value_from) / (value_to - value_from);
        const double value = field.distance_mm(foot + t * up);
        if (std::abs(value) <= kClose) return t;
        if ((value < 0) == (value_to < 0)) {
            value_from *= 0.5;
        } else {
            from = to;
            value_from = value_to;
        }
        to = t;
        value_to = value;
    }
    return 0.5 * (from + to);
}

}  // namespace

std::optional<double> height_over(const contact::DistanceField& field, Vec3 foot_mm, Vec3 up,
                                  double limit_mm) {
    const auto within = [&](double t) { return std::abs(t) <= limit_mm ? std::optional(t) : std::nullopt; };
    double t = 0, value = field.distance_mm(foot_mm);
    const double way = value < 0 ? 1 : -1;
    while (std::abs(value) > kClose) {
        if (std::abs(t) > limit_mm) return std::nullopt;
        const double next = t + way * std::max(std::abs(value), kStep);
        const double next_value = field.distance_mm(foot_mm + next * up);
        if ((next_value < 0) != (value < 0))
            return within(refine(field, foot_mm, up, t, value, next, next_value));
        t = next;
        value = next_value;
    }
    return within(t);
}

}  // namespace tribo::surface
