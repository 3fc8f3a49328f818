// SPDX-License-Identifier: MIT
#include "milling/sweep/sweep_frames.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"

namespace tribo::milling {
namespace {

// Returns the quadratic of a straight tip and an axis that turns evenly along the great circle, to the fifth
// order.
motion::Quadratic even_turn(const motion::Move& move) {
    const motion::ToolPose middle = motion::pose_at(move, 0.5);
    const double half = 0.5 * motion::angle_rad(move.start.axis, move.end.axis);
    const double size = half > 1e-4 ? math::sin(half) / half : 1 - half * half / 6;
    return {middle.tip_mm, (2 * size) * middle.axis - 0.5 * (move.start.axis + move.end.axis)};
}

}  // namespace

Box3 tool_box(const ToolCylinder& tool, Vec3 tip, Vec3 axis) {
    const double r = tool.radius_mm;
    const auto reach = [r](double u) { return r * std::sqrt(std::max(0.0, 1 - u * u)); };
    const Vec3 disc{reach(axis.x), reach(axis.y), reach(axis.z)};
    Box3 box;
    for (const Vec3 centre : {tip, tip + tool.length_mm * axis}) {
        box.include(centre - disc);
        box.include(centre + disc);
    }
    return box;
}

StraightFrame::StraightFrame(Vec3 from, Vec3 travel, Vec3 axis) : start(from) {
    double rise = dot(travel, axis);
    Vec3 across = travel - rise * axis;
    // A part along or across the axis below this share is rounding of the axis itself.
    constexpr double kRounding = 1e-12;
    if (std::abs(rise) < kRounding * length(across)) rise = 0;
    if (length(across) < kRounding * std::abs(rise)) across = {};
    frame.z = axis;
    frame.x = normalized(across, any_perpendicular(axis));
    // Beside a long travel along the axis the rounding of the part across it is no longer small.
    if (const double along = dot(frame.x, axis); std::abs(along) > 1e-10)
        frame.x = normalized(frame.x - along * axis, any_perpendicular(axis));
    frame.y = cross(frame.z, frame.x);
    line = StraightLine(length(across), rise);
}

Box3 StraightFrame::box(const ToolCylinder& tool) const {
    Box3 box = tool_box(tool, start, frame.z);
    box.include(tool_box(tool, start + travel(), frame.z));
    return box;
}

ArcFrame::ArcFrame(const motion::Move& move) {
    const motion::Arc& arc = *move.arc;
    const Vec3 axis = move.start.axis;
    const Vec3 from_centre = move.start.tip_mm - arc.centre_mm;
    const Vec3 radial = from_centre - dot(from_centre, axis) * axis;
    centre = move.start.tip_mm - radial;
    line.radius = length(radial);
    frame.z = axis;
    frame.x = normalized(radial, any_perpendicular(axis));
    frame.y = cross(frame.z, frame.x);
    // A right turn is a left turn with y mirrored. The formula is the same for both.
    const double turn = arc.turn_rad * (dot(arc.normal, axis) < 0 ? -1 : 1);
    if (turn < 0) frame.y = -frame.y;
    assert(std::abs(turn) <= math::kPi + 1e-9);
    math::sincos(std::abs(turn), line.end_y, line.end_x);
    line.end_y = std::max(line.end_y, 0.0);
}

Vec3 ArcFrame::nearest(Vec3 point) const {
    const Vec3 begin{line.radius, 0, 0}, end = line.radius * Vec3{line.end_x, line.end_y, 0};
    const Vec3 level{point.x, point.y, 0};
    if (std::min(point.y, point.x * line.end_y - point.y * line.end_x) >= 0)
        return line.radius * normalized(level, {1, 0, 0});
    return squared_length(level - begin) < squared_length(level - end) ? begin : end;
}

Box3 ArcFrame::box(const ToolCylinder& tool) const {
    Box3 box;
    const Box3 still = tool_box(tool, {}, frame.z);
    // The extremes of the path: its ends, and the points where its tangent has no part along a coordinate.
    const auto include = [&](Vec3 radial) {
        const Vec3 tip = centre + line.radius * radial;
        box.include(Box3{tip + still.min, tip + still.max});
    };
    include(frame.x);
    include(line.end_x * frame.x + line.end_y * frame.y);
    for (int k = 0; k < 3; ++k) {
        for (const double sign : {1.0, -1.0}) {
            const Vec3 toward = normalized({sign * frame.x[k], sign * frame.y[k], 0}, {1, 0, 0});
            if (toward.y >= 0 && toward.x * line.end_y - toward.y * line.end_x >= 0)
                include(toward.x * frame.x + toward.y * frame.y);
        }
    }
    return box;
}

CurvedLine curved_line(const motion::Move& move) {
    const motion::Quadratic middle = move.quadratic ? *move.quadratic : even_turn(move);
    const Vec3 a = move.start.axis, b = move.end.axis;
    const Vec3 tip1 = 2 * (middle.tip_control_mm - move.start.tip_mm), axis1 = 2 * (middle.axis_control - a);
    return {tip1, move.end.tip_mm - move.start.tip_mm - tip1, a, axis1, b - a - axis1};
}

Box3 curved_box(const ToolCylinder& tool, const CurvedLine& line, Vec3 start) {
    // A point of the tool deviates from the chord between two neighbouring poses by at most a share of the
    // square of their spacing.
    constexpr int kPoses = 17;
    const double turn = length(line.axis1) + 2 * length(line.axis2);
    const double bend = 2 * length(line.tip2) +
                        (tool.length_mm + tool.radius_mm) * (2 * length(line.axis2) + 2 * turn * turn);
    Box3 box;
    for (int n = 0; n < kPoses; ++n) {
        const double t = n / (kPoses - 1.0);
        const Vec3 axis = normalized(line.axis0 + t * (line.axis1 + t * line.axis2));
        box.include(tool_box(tool, start + t * (line.tip1 + t * line.tip2), axis));
    }
    return box.inflated(bend / (8.0 * (kPoses - 1) * (kPoses - 1)));
}

}  // namespace tribo::milling
