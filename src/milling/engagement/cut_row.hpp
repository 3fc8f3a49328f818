// SPDX-License-Identifier: MIT
// One row of a cut: a stretch of the path that is short enough for one engagement. forces.csv, report, sound,
// haptics and page all show this record, each in its own form. The force of the row is a separate record
// (milling/force/row_force.hpp). Angles in rad, speeds in mm/s, times from the start of the program.
//
// Machining fills in the fields under "The cut"; the session adds time and spindle.
#pragma once

#include "base/math.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/tool/cut_pose.hpp"

namespace tribo::milling {

struct CutRow {
    // The cut.
    std::size_t step = 0;     // index in a run of Machining: the first step of the row's pass
    double from = 0, to = 0;  // fractions of that step; of the path of the whole pass if other steps join it
    double length_mm = 0;     // of the tip's path
    CutPose pose;             // in the middle, stock frame; its travel is that of the whole row
    Engagement engagement;    // in the middle
    double chip_mm3 = 0;      // the volume that the engagement cuts
    double core_mm3 = 0;      // the volume that the cutter's core moves into, where it has no edges
    double removed_mm3 = 0;   // this row's share of the volume that the stock lost
    double reconciled = 1;    // factor on the chips: with it they fill the volume that the stock lost
    // Time and spindle.
    int line = 0;  // of the program, from 1
    std::size_t cutter = 0;
    double start_s = 0, end_s = 0;
    double spindle_rpm = 0;
    double phase_rad = 0;    // of the spindle, at start_s
    double phase_turns = 0;  // whole turns before phase_rad
    ToolTravel feed;         // travel per tooth, multiplied by `reconciled`

    double duration_s() const { return end_s - start_s; }
    double feed_mm_per_s() const { return duration_s() > 0 ? length_mm / duration_s() : 0; }  // of the tip
    double chip_mm3_per_s() const { return duration_s() > 0 ? chip_mm3 / duration_s() : 0; }
    double spindle_rad_per_s() const { return spindle_rpm / 60 * math::kTwoPi; }
    double phase_at_rad(double t_s) const { return phase_rad + spindle_rad_per_s() * (t_s - start_s); }
};

}  // namespace tribo::milling
