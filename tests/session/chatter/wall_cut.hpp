// SPDX-License-Identifier: MIT
// A straight cut along a wall, of one cutter with one engagement.
#pragma once

#include <vector>

#include "base/math.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

struct Wall {
    milling::Cutter cutter{.diameter_mm = 10, .flutes = 2, .helix_deg = 0, .length_mm = 20};
    std::vector<dynamics::Mode> modes;
    milling::CuttingCoefficients coefficients{600, 200, 0, 0, 0, 0};
    double rpm = 8000, feed_mm = 0.1, depth_mm = 1, seconds = 0.5;
    double entry_rad = 0, exit_rad = math::kPi;
    Vec3 feed{1, 0, 0}, axis{0, 0, 1};
};

inline double feed_speed(const Wall& w) {
    return w.feed_mm * w.cutter.flutes * w.rpm / 60;
}

inline MillSetup setup_of(const Wall& w) {
    MillSetup setup;
    setup.cutters = {w.cutter};
    setup.coefficients = w.coefficients;
    setup.modes_of_cutter = {w.modes};
    motion::Move move;
    move.start = {{1, 2, 3}, w.axis};
    move.end = {move.start.tip_mm + feed_speed(w) * w.seconds * w.feed, w.axis};
    move.feed_mm_per_min = 60 * feed_speed(w);
    setup.moves = {move};
    setup.cutter_of_move = {0};
    setup.rpm_of_move = {w.rpm};
    setup.schedule = schedule_of(setup);
    return setup;
}

inline milling::CutRow row_of(const Wall& w, const MillSetup& setup, double start_s, double end_s) {
    milling::CutRow row;
    row.line = 1;
    row.start_s = start_s;
    row.end_s = end_s;
    row.spindle_rpm = w.rpm;
    row.phase_rad = row.spindle_rad_per_s() * start_s;
    row.pose.frame = milling::tool_frame(w.axis, w.feed, w.feed);
    row.pose.tip_mm = motion::pose_at_time(setup.moves, *setup.schedule, 0.5 * (start_s + end_s)).tip_mm;
    row.feed.across_mm = w.feed_mm;
    row.engagement.bands = {{0, w.depth_mm, w.entry_rad, w.exit_rad}};
    return row;
}

}  // namespace tribo::session
