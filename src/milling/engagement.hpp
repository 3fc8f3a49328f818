// SPDX-License-Identifier: MIT
// Where the edges are in material: per axial band, the interval of rotation in which an edge at that height
// cuts.
#pragma once

#include <vector>

namespace tribo::milling {

// Angles in rad, clockwise seen from the shank, from the left of the feed (the y axis of the tool's frame):
// 0 <= entry < exit <= 2 pi. Heights in mm above the tip. A band may appear several times with different
// intervals.
struct EngagementBand {
    double z0_mm = 0, z1_mm = 0;
    double entry_rad = 0, exit_rad = 0;
};

struct Engagement {
    std::vector<EngagementBand>
        bands;                   // of the lateral edge (cylinder, corner, ball), sorted by z0 then entry
    double bottom_fraction = 0;  // 0..1: share of the flat bottom disc that cuts (plunging, ramping)

    bool empty() const { return bands.empty() && bottom_fraction <= 0; }
    void clear() {
        bands.clear();
        bottom_fraction = 0;
    }
};

}  // namespace tribo::milling
