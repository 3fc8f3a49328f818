// SPDX-License-Identifier: MIT
#include "dynamics/engaged_zone.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::dynamics {
namespace {

// Moves an angle into [from, from + 2 pi).
double wrapped(double angle, double from) {
    return angle - math::kTwoPi * std::floor((angle - from) / math::kTwoPi);
}

}  // namespace

EngagedZone engaged_zone(const milling::EngagementBand& band, double rotation_rad, double lag_per_mm) {
    const double height = band.z1_mm - band.z0_mm;
    if (lag_per_mm == 0) {
        const double at = wrapped(rotation_rad, band.entry_rad);
        return {band.z0_mm, at < band.exit_rad ? band.z1_mm : band.z0_mm};
    }
    // The rotation of the band's bottom, less the lag up to z, lies between entry and exit.
    const double bottom = rotation_rad - lag_per_mm * band.z0_mm;
    const double lowest = std::min(0.0, -lag_per_mm * height), highest = std::max(0.0, -lag_per_mm * height);
    const double at = wrapped(bottom + lowest, band.entry_rad - (highest - lowest)) - lowest;
    double a = (at - band.exit_rad) / lag_per_mm, b = (at - band.entry_rad) / lag_per_mm;
    if (a > b) std::swap(a, b);
    return {band.z0_mm + std::clamp(a, 0.0, height), band.z0_mm + std::clamp(b, 0.0, height)};
}

}  // namespace tribo::dynamics
