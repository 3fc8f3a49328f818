// SPDX-License-Identifier: MIT
// The parts of a helical edge that are in the cut at an instant.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "milling/engagement/engagement.hpp"

namespace tribo::dynamics {

struct EngagedZone {
    double z0_mm, z1_mm;  // z0 < z1
};

// Calls use(EngagedZone) for each part of an edge in a band, whose end at the tip is at that rotation (any
// turn). `lag_per_mm`: of the edge behind its tip, < 0 on a left-hand helix. A band higher than a turn of the
// helix has several parts. Real-time safe.
template <class Use>
void for_each_zone(const milling::EngagementBand& band, double rotation_rad, double lag_per_mm, Use&& use) {
    const double bottom = rotation_rad - lag_per_mm * band.z0_mm;
    const double top = rotation_rad - lag_per_mm * band.z1_mm;
    const double low = std::min(bottom, top), high = std::max(bottom, top);
    // The edge stands from low to high; it cuts from entry to exit, in every turn.
    double turn = math::kTwoPi * std::ceil((low - band.exit_rad) / math::kTwoPi);
    for (; band.entry_rad + turn <= high; turn += math::kTwoPi) {
        if (lag_per_mm == 0) {
            if (low < band.exit_rad + turn) use(EngagedZone{band.z0_mm, band.z1_mm});
            continue;
        }
        const double from = std::max(low, band.entry_rad + turn), to = std::min(high, band.exit_rad + turn);
        const double z_from = (rotation_rad - from) / lag_per_mm, z_to = (rotation_rad - to) / lag_per_mm;
        if (to > from) use(EngagedZone{std::min(z_from, z_to), std::max(z_from, z_to)});
    }
}

}  // namespace tribo::dynamics
