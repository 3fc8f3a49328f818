// SPDX-License-Identifier: MIT
#include "motion/summary.hpp"

#include <algorithm>
#include <cassert>

#include "motion/direction.hpp"

namespace tribo::motion {
namespace {

constexpr Vec3 kUpright{0, 0, 1};

void include(Range& range, double value) {
    if (value <= 0) return;
    range.least = range.least > 0 ? std::min(range.least, value) : value;
    range.most = std::max(range.most, value);
}

void add_feed_move(ProgramSummary& summary, const Move& move) {
    const double length = path_length_mm(move);
    ++summary.feed_moves;
    summary.path_mm += length;
    summary.bounds_mm.include(tip_bounds(move));
    summary.tilted = summary.tilted || move.start.axis != kUpright || move.end.axis != kUpright;
    for (const ToolPose& pose : {move.start, move.end})
        if (pose.axis != kUpright)
            summary.tilt_rad = std::max(summary.tilt_rad, angle_rad(kUpright, pose.axis));
    include(summary.feed_mm_per_min, move.feed_mm_per_min);
    include(summary.spindle_rpm, move.spindle_rpm);
    if (move.duration_s > 0) {
        summary.feed_s += move.duration_s;
    } else if (move.feed_mm_per_min > 0) {
        summary.feed_s += 60 * length / move.feed_mm_per_min;
    }
}

}  // namespace

ProgramSummary describe(const Program& program, double rapid_mm_per_min) {
    assert(rapid_mm_per_min > 0);
    ProgramSummary summary;
    summary.rotary = program.has_rotary_words;
    int last_tool = 0;
    for (const Move& move : program.moves) {
        if (move.tool != last_tool && move.tool != 0) summary.tools.push_back(move.tool);
        last_tool = move.tool;
        switch (move.kind) {
            case MoveKind::feed:
                add_feed_move(summary, move);
                break;
            case MoveKind::rapid:
                summary.rapid_mm += path_length_mm(move);
                break;
            case MoveKind::dwell:
                summary.dwell_s += move.duration_s;
                continue;
        }
        ++summary.moves;
    }
    summary.rapid_s = 60 * summary.rapid_mm / rapid_mm_per_min;
    std::ranges::sort(summary.tools);
    summary.tools.erase(std::unique(summary.tools.begin(), summary.tools.end()), summary.tools.end());
    return summary;
}

}  // namespace tribo::motion
