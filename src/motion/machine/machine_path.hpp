// SPDX-License-Identifier: MIT
// Converts a block with rotary words, one move of the joints, into moves of tool tip and axis in the stock.
// Any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/machine/kinematics.hpp"
#include "motion/path/moves.hpp"

namespace tribo::motion {

// One block in the coordinates of the program. With tool tip control they are coordinates of the tip in the
// stock's frame. Without it they are X, Y and Z of the machine, relative to the stock's zero (as with the
// rotary axes at zero), and all joints run evenly. In both cases the rotary axes turn evenly from start to
// end.
struct MachineBlock {
    bool tip_control = false;
    Vec3 start_mm, end_mm;
    // The curve from start to end, if it is not straight; also in the program's coordinates. The axis of the
    // quadratic has no meaning.
    Rare<Arc> arc;
    Rare<Quadratic> quadratic;
    Vec3 start_rad, end_rad;
};

// Return the joints and the pose at the fraction t of the block, 0..1.
Joints joints_at(const Kinematics& machine, const MachineBlock& block, double t);
ToolPose pose_at(const Kinematics& machine, const MachineBlock& block, double t);

// Appends the block as moves that join end to start. Each has the words of `like` and its share of the
// duration of `like`, if there is one; a feed move with a duration gets the feed of its tip. A block that
// does not move its rotary axes stays one straight move or arc, turned with the part. A block that turns them
// becomes quadratic pieces within the tolerance, or one straight move if the axis runs evenly along a great
// circle. Returns false if more than `most` moves were needed; then the rest of the block is missing.
bool append_moves(const Kinematics& machine, const MachineBlock& block, const Move& like,
                  const PieceTolerance& tolerance, std::size_t most, std::vector<Move>& moves);

}  // namespace tribo::motion
