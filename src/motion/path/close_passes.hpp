// SPDX-License-Identifier: MIT
// Distance between neighbouring passes of a program, and the inclination of the tool there. A grid must
// resolve this distance to show the ridges between the passes.
#pragma once

#include <span>

#include "motion/path/program.hpp"

namespace tribo::motion {

struct ClosePasses {
    double share = 0;        // of the feed path, 0..1, with another pass beside it within `within_mm`
    double sidestep_mm = 0;  // median distance to it over that share; 0 if there is none
    // At the place of the median: the angle of the tool axis from the normal of the plane through both
    // passes, 0..pi/2, and the angle between the direction of its lean and the feed, 0..pi/2.
    double tilt_rad = 0, turn_rad = 0;
};

// Searches from 2000 places spread evenly over the feed path for other passes within `within_mm` > 0. A pass
// is a neighbour if it runs parallel or back (to 25 degrees) beside the place and does not belong to the
// path's own stretch there. Another depth in the same track is no neighbour, and neither is a track that is
// run again. Time is linear in moves and path, plus the search, which takes at most 400,000 steps beyond one
// per move (tens of ms). Uses 2 MB meanwhile. Any thread.
ClosePasses close_passes(std::span<const Move> moves, double within_mm);

}  // namespace tribo::motion
