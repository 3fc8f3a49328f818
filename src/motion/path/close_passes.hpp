// SPDX-License-Identifier: MIT
// How near neighbouring passes of a program come to each other: what a grid must resolve to show the ridges
// that they leave, and how the tool leans there.
#pragma once

#include <span>

#include "motion/path/program.hpp"

namespace tribo::motion {

struct ClosePasses {
    double share = 0;        // of the feed path, 0..1: has another pass beside it, nearer than asked for
    double sidestep_mm = 0;  // median distance to it over that share; 0 where there is none
    // At the place of the median: the tool axis from the normal of the plane through both passes, 0..pi/2,
    // and the direction in which it leans from that of the feed, 0..pi/2.
    double tilt_rad = 0, turn_rad = 0;
};

// Looks from 2000 places spread evenly over the feed path for other passes within `within_mm` > 0. A pass is
// a neighbour where it runs parallel or back (to 25 degrees) beside the place, off the path's own stretch
// there: another depth in the same track is none, a track run again is none. Time grows with moves and path
// but for the search, which takes at most 400,000 steps beyond one a move (tens of ms); 2 MB meanwhile. Any
// thread.
ClosePasses close_passes(std::span<const Move> moves, double within_mm);

}  // namespace tribo::motion
