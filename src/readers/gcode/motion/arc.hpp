// SPDX-License-Identifier: MIT
// Arcs as G2 and G3 state them: by centre or by radius, in one of three planes (RS274/NGC 3.5.3).
#pragma once

#include <array>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Numbers of the axes (0 x, 1 y, 2 z) that make a plane: first, second and normal, right-handed.
constexpr std::array<int, 3> axes_of(Plane plane) {
    switch (plane) {
        case Plane::zx:
            return {2, 0, 1};
        case Plane::yz:
            return {1, 2, 0};
        default:
            return {0, 1, 2};
    }
}

// What both ways of stating an arc share; mm.
struct ArcEnds {
    Plane plane = Plane::xy;
    bool clockwise = false;  // seen against the plane's normal
    Vec3 start_mm, end_mm;
    int extra_turns = 0;
};

// The arc about a centre, of which only the two coordinates in the plane count. Ends at the start: a full
// circle. Start and end may differ in their distance from the centre by 0.5 mm if that is under 0.1 % of it,
// always by 0.005 mm (in inches 0.05 and 0.0005): LinuxCNC's rule.
Result<motion::Arc> arc_about_centre(const ArcEnds& ends, Vec3 centre_mm, double unit_mm);

// The arc of a radius, mm: at most half a turn for a positive one, at least half a turn for a negative one.
// Half a chord may be longer than the radius by 0.005 mm.
Result<motion::Arc> arc_of_radius(const ArcEnds& ends, double radius_mm);

}  // namespace tribo::readers::gcode
