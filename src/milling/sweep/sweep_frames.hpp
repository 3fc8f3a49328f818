// SPDX-License-Identifier: MIT
// The frames of elementary moves, and the boxes of what they sweep. All sweeps of a move use the same.
#pragma once

#include "milling/sweep/sweep_lines.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {

// A cylinder from the tip up that contains the cutter.
struct ToolCylinder {
    double radius_mm = 0, length_mm = 0;
};

// Returns the box of the tool at one pose, cap included.
Box3 tool_box(const ToolCylinder& tool, Vec3 tip, Vec3 axis);

// A straight move with one axis. x runs along the part of the travel across the axis.
struct StraightFrame {
    Vec3 start;
    Frame frame;
    StraightLine line;

    StraightFrame(Vec3 from, Vec3 travel, Vec3 axis);
    Vec3 travel() const { return line.across * frame.x + line.rise * frame.z; }
    Box3 box(const ToolCylinder& tool) const;
};

// An arc about a line parallel to the axis, without rise. x points to its start.
struct ArcFrame {
    Vec3 centre;  // at the height of the tip
    Frame frame;
    ArcLine line;

    explicit ArcFrame(const motion::Move& move);
    // Returns the point of the path that is nearest to a point of the frame, at height 0.
    Vec3 nearest(Vec3 point) const;
    Box3 box(const ToolCylinder& tool) const;
};

// Returns tip and axis of any other move.
CurvedLine curved_line(const motion::Move& move);
Box3 curved_box(const ToolCylinder& tool, const CurvedLine& line, Vec3 start);

}  // namespace tribo::milling
