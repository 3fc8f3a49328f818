// SPDX-License-Identifier: MIT
// The effective cutting shape of an inclined end mill seen along the feed, and the cusps between passes. The
// tool axis leans by `tilt` from the surface normal, towards a direction that lies `turn` from the feed in
// the surface (turn 0: pure lead). Lengths in mm, angles in rad, 0 <= tilt < pi / 2, |turn| <= pi / 2. No
// allocation; any thread.
//
// Seen along the feed the bottom circle of a flat end mill is an ellipse. A ball is a circle. A torus (corner
// r on the circle R - r) is the ellipse of that circle grown by r. Where the normal is perpendicular to the
// tool axis, the flank follows. A cutter with a profile has no such form: do not pass it here. Derived here
// and checked by sampling the tool, see the tests.
#pragma once

#include "milling/tool/cutter.hpp"

namespace tribo::milling {

struct Inclination {
    double tilt_rad = 0;
    double turn_rad = 0;
};

// Returns the width of the cutting shape at this height above its lowest point, h >= 0. Exact: closed form
// below the flank of flat and ball, otherwise to 1e-12 of the cutter's radius.
double effective_width_mm(const Cutter& cutter, Inclination inclination, double height_mm);

// Returns the height of the cusps between straight passes `sidestep_mm` apart on a plane: the height at which
// the width equals the sidestep. The same accuracy. For a flat end mill below its flank: R sin(tilt) (1 -
// sqrt(1 - (s / (2 R cos(turn)))^2)). Infinite if the passes do not meet.
double scallop_height_mm(const Cutter& cutter, Inclination inclination, double sidestep_mm);

}  // namespace tribo::milling
