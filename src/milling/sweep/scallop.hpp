// SPDX-License-Identifier: MIT
// What an inclined end mill leaves on a surface: its effective cutting shape, seen along the feed, and the
// cusps between passes. The tool axis leans by `tilt` from the surface normal, towards a direction that lies
// `turn` from the feed in the surface (turn 0: pure lead). Lengths in mm, angles in rad, 0 <= tilt < pi / 2,
// |turn| <= pi / 2. No allocation; any thread.
//
// Seen along the feed the bottom circle of a flat end mill is an ellipse, a ball a circle, and a torus
// (corner r on the circle R - r) the ellipse of that circle grown by r; where its normal lies across the tool
// axis the flank goes on. Derived here and checked by sampling the tool, see the tests.
#pragma once

#include "milling/tool/cutter.hpp"

namespace tribo::milling {

struct Inclination {
    double tilt_rad = 0;
    double turn_rad = 0;
};

// Width of the cutting shape at this height above its lowest point, h >= 0. Exact: closed form below the
// flank of flat and ball, to 1e-12 of the cutter's radius else.
double effective_width_mm(const Cutter& cutter, Inclination inclination, double height_mm);

// Height of the cusps between straight passes `sidestep_mm` apart on a plane: where the width is the
// sidestep. Exact likewise; for a flat end mill below its flank R sin(tilt) (1 - sqrt(1 - (s / (2 R
// cos(turn)))^2)). Infinite where the passes do not meet.
double scallop_height_mm(const Cutter& cutter, Inclination inclination, double sidestep_mm);

}  // namespace tribo::milling
