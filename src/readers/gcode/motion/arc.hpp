// SPDX-License-Identifier: MIT
// Arcs of G2 and G3: by centre or by radius, in one of three planes (RS274/NGC 3.5.3).
#pragma once

#include <array>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {

// Axis numbers (0 x, 1 y, 2 z) of a plane: first, second and normal, right-handed.
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

// Data of an arc by centre or by radius; mm.
struct ArcEnds {
    Plane plane = Plane::xy;
    bool clockwise = false;  // seen against the normal of the plane
    Vec3 start_mm, end_mm;
    int extra_turns = 0;
    bool is_coarse = false;  // the numbers may have two decimals, in inches three
};

// Returns the arc about a centre; only the two coordinates in the plane are used. End = start: a full circle.
// The distances of start and end from the centre may differ by 0.5 mm if that is less than 0.1 % of the
// distance, and always by 0.005 mm (in inches 0.05 and 0.0005): rule in the manual of LinuxCNC, and of Grbl.
// Coarse ones may differ by 0.0283 mm (0.00283 inches): what LinuxCNC takes unless its set-up says less
// (CENTER_ARC_RADIUS_TOLERANCE in src/emc/rs274ngc/interp_internal.hh). Fanuc controls take what their
// parameter 3410 says, which no program tells.
Result<motion::Arc> arc_about_centre(const ArcEnds& ends, Vec3 centre_mm, double unit_mm);

// Number of lines that stay within a micrometre of an arc that begins at `start_mm`; for arcs whose plane is
// rolled about a cylinder.
double chord_count(const motion::Arc& arc, Vec3 start_mm);

// Returns the arc of a radius, mm: at most half a turn for a positive radius, at least half a turn for a
// negative one. Half the chord may exceed the radius by 0.005 mm.
Result<motion::Arc> arc_of_radius(const ArcEnds& ends, double radius_mm);

}  // namespace tribo::readers::gcode
