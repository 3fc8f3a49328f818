// SPDX-License-Identifier: MIT
#include "milling/engagement/joined_moves.hpp"

#include <algorithm>
#include <cmath>

#include "motion/path/path.hpp"

namespace tribo::milling {
namespace {

constexpr double kLongestRow = 0.5;  // mm
constexpr double kLongestOfDiameter = 0.5;
// Largest number of moves and of rows in one pass: viewers see the stock between passes only.
constexpr int kMostJoined = 16;
constexpr double kMostRows = 4;
// Longest move that shares a sweep, in radii of the cutter. Near a longer one lie few others: each of the two
// alone is asked for less than both together.
constexpr double kLongestPart = 0.2;
// The travel of the tip and of the upper end of the flutes may differ from the first one by this share.
constexpr double kOffWay = 0.05;
constexpr double kOffFeed = 0.02;
// Ends and starts that are nearer than this join, mm and rad.
constexpr double kJoint = 1e-4;

}  // namespace

double longest_row_mm(const Cutter& cutter) {
    return std::min(kLongestRow, kLongestOfDiameter * cutter.diameter_mm);
}

bool shares_sweep(const motion::Move& move, const Cutter& cutter) {
    return row_way_mm(move, cutter) <= kLongestPart * cutter.radius_mm();
}

double row_way_mm(const motion::Move& move, const Cutter& cutter) {
    return std::max(motion::path_length_mm(move), 0.5 * cutter.length_mm * motion::axis_turn_rad(move));
}

double rows_of(double way_mm, const Cutter& cutter) {
    return std::max(1.0, std::ceil(way_mm / longest_row_mm(cutter) - 1e-9));
}

bool JoinedMoves::goes_on(const Way& way) const {
    const double size = length(way.tip_mm), scale = size / length(first_.tip_mm);
    return length(way.tip_mm - scale * first_.tip_mm) <= kOffWay * size &&
           length(way.top_mm - scale * first_.top_mm) <= kOffWay * size;
}

bool JoinedMoves::add(const motion::Move& move, const Cutter& cutter, double spindle_rpm, double duration_s) {
    const double path = motion::path_length_mm(move);
    if (move.kind != motion::MoveKind::feed || !(path > 0) || !(duration_s > 0)) return open_ = false;
    const motion::ToolPose middle = motion::pose_at(move, 0.5);
    const auto way = [&](const motion::ToolPose& from, const motion::ToolPose& to) {
        const Vec3 tip = to.tip_mm - from.tip_mm;
        return Way{tip, tip + cutter.length_mm * (to.axis - from.axis)};
    };
    const Way begin = way(move.start, middle), rest = way(middle, move.end);
    const double feed = path / duration_s, own_way = row_way_mm(move, cutter);
    const double rows = rows_of(way_mm_ + own_way, cutter);
    const bool joins = open_ && count_ < kMostJoined && &cutter == cutter_ && spindle_rpm == spindle_rpm_ &&
                       std::abs(feed - feed_mm_per_s_) <= kOffFeed * feed_mm_per_s_ && rows <= kMostRows &&
                       rows < rows_of(way_mm_, cutter) + rows_of(own_way, cutter) &&
                       distance(move.start.tip_mm, end_.tip_mm) < kJoint &&
                       distance(move.start.axis, end_.axis) < kJoint && goes_on(begin) && goes_on(rest);
    if (!joins) {
        count_ = 0;
        way_mm_ = 0;
        feed_mm_per_s_ = feed;
        spindle_rpm_ = spindle_rpm;
        cutter_ = &cutter;
        first_ = begin;
        open_ = length(begin.tip_mm) > 0 && goes_on(rest);
    }
    ++count_;
    way_mm_ += own_way;
    end_ = move.end;
    return joins;
}

}  // namespace tribo::milling
