// SPDX-License-Identifier: MIT
// Engagement: for each axial band, the interval of rotation in which an edge at that height is in material.
#pragma once

#include <algorithm>
#include <vector>

namespace tribo::milling {

// Angles in rad, clockwise seen from the shank, from the left of the feed (the y axis of the tool's frame):
// 0 <= entry < exit <= 2 pi. Heights in mm above the tip. A band may appear several times with different
// intervals.
struct EngagementBand {
    double z0_mm = 0, z1_mm = 0;
    double entry_rad = 0, exit_rad = 0;
};

// The same for the straight edges of a flat bottom, or of another level part of a profile, between two radii
// in mm.
struct BottomBand {
    double r0_mm = 0, r1_mm = 0;
    double entry_rad = 0, exit_rad = 0;
    double z_mm = 0;  // above the tip
    bool faces_up = false;
};

struct Engagement {
    std::vector<EngagementBand> bands;  // of the lateral edge (cylinder, corner, ball), sorted by z0
    std::vector<BottomBand> bottom;     // sorted by r0

    bool empty() const { return bands.empty() && bottom.empty(); }
    void clear() {
        bands.clear();
        bottom.clear();
    }
};

// The hull of all bands of the lateral edge; all zero without bands.
struct EngagementHull {
    double entry_rad = 0, exit_rad = 0;
    double axial_depth_mm = 0;  // from the lowest band's bottom to the highest band's top
};

inline EngagementHull hull(const Engagement& engagement) {
    if (engagement.bands.empty()) return {};
    EngagementHull hull{engagement.bands[0].entry_rad, engagement.bands[0].exit_rad, 0};
    double low = engagement.bands[0].z0_mm, high = engagement.bands[0].z1_mm;
    for (const EngagementBand& b : engagement.bands) {
        hull.entry_rad = std::min(hull.entry_rad, b.entry_rad);
        hull.exit_rad = std::max(hull.exit_rad, b.exit_rad);
        low = std::min(low, b.z0_mm);
        high = std::max(high, b.z1_mm);
    }
    hull.axial_depth_mm = high - low;
    return hull;
}

}  // namespace tribo::milling
