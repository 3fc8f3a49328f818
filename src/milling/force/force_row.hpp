// SPDX-License-Identifier: MIT
// What is known of one piece of the cut, at most 0.5 mm of path: a row of forces.csv.
#pragma once

#include "base/vec3.hpp"

namespace tribo::milling {

// Force acts on the tool, in the tool's frame: x along the feed, y to its left, z to the shank.
struct ForceRow {
    double t_s = 0;         // at the start of the piece, from the start of the program
    double duration_s = 0;  // of the piece
    int line = 0;           // of the program, from 1
    Vec3 tip_mm;            // stock frame
    Vec3 axis{0, 0, 1};
    double spindle_rpm = 0;
    double feed_mm_per_min = 0;          // of the tip
    double entry_deg = 0, exit_deg = 0;  // hull over the bands, clockwise from y, 0 to 360
    double axial_depth_mm = 0;           // from the lowest band's bottom to the highest band's top
    Vec3 mean_n;                         // over a turn of the spindle
    Vec3 peak_n;                         // each component's extreme of largest size over the turn, signed
    double peak_fxy_n = 0;               // largest size of the force across the axis
    double mean_torque_nm = 0, peak_torque_nm = 0;
    double removed_mm3 = 0;  // by this piece
    // What the measured chips were multiplied by so that they fill the volume that the stock lost.
    double reconciled = 1;
};

}  // namespace tribo::milling
