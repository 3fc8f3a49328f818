// SPDX-License-Identifier: MIT
// The part of a helical edge that is in the cut at an instant.
#pragma once

#include "milling/engagement/engagement.hpp"

namespace tribo::dynamics {

struct EngagedZone {
    double z0_mm, z1_mm;  // equal: no part
};

// Of an edge in a band, whose end at the tip is at that rotation (any turn). `lag_per_mm`: of the edge behind
// its tip, < 0 on a left-hand helix. The band must be lower than a turn of the helix. Real-time safe.
EngagedZone engaged_zone(const milling::EngagementBand& band, double rotation_rad, double lag_per_mm);

}  // namespace tribo::dynamics
