// SPDX-License-Identifier: MIT
#include "motion/path/summary.hpp"

#include <algorithm>
#include <cassert>

#include "motion/algebra/direction.hpp"

namespace tribo::motion {
namespace {

constexpr Vec3 kUpright{0, 0, 1};

void include(Range& range, double value) {
    if (value <= 0) return;
    range.least = range.least > 0 ? std::min(range.least, value) : value;
    range.most = std::max(range.most, value);
}

}  // namespace

void ProgramMeter::add_feed(const Move& move) {
    const double length = path_length_mm(move);
    ++so_far_.feed_moves;
    so_far_.path_mm += length;
    so_far_.bounds_mm.include(tip_bounds(move));
    so_far_.tilted = so_far_.tilted || move.start.axis != kUpright || move.end.axis != kUpright;
    for (const ToolPose& pose : {move.start, move.end})
        if (pose.axis != kUpright)
            so_far_.tilt_rad = std::max(so_far_.tilt_rad, angle_rad(kUpright, pose.axis));
    include(so_far_.feed_mm_per_min, move.feed_mm_per_min);
    include(so_far_.spindle_rpm, move.spindle_rpm);
    if (move.duration_s > 0) {
        so_far_.feed_s += move.duration_s;
    } else if (move.feed_mm_per_min > 0) {
        so_far_.feed_s += 60 * length / move.feed_mm_per_min;
    }
}

void ProgramMeter::add(const Move& move) {
    std::vector<int>& tools = so_far_.tools;
    if (move.tool != last_tool_ && move.tool != 0) {
        const auto place = std::ranges::lower_bound(tools, move.tool);
        if (place == tools.end() || *place != move.tool) tools.insert(place, move.tool);
    }
    last_tool_ = move.tool;
    switch (move.kind) {
        case MoveKind::feed:
            add_feed(move);
            break;
        case MoveKind::rapid:
            so_far_.rapid_mm += path_length_mm(move);
            break;
        case MoveKind::dwell:
            so_far_.dwell_s += move.duration_s;
            return;
    }
    ++so_far_.moves;
}

ProgramSummary ProgramMeter::summary(double rapid_mm_per_min) const {
    assert(rapid_mm_per_min > 0);
    ProgramSummary summary = so_far_;
    summary.rapid_s = 60 * summary.rapid_mm / rapid_mm_per_min;
    return summary;
}

}  // namespace tribo::motion
