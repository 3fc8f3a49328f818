// SPDX-License-Identifier: MIT
// What a block with rotary words does to the tip in the stock: one move of the joints as moves of tool tip
// and axis. Any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/machine/kinematics.hpp"
#include "motion/path/moves.hpp"

namespace tribo::motion {

// One block in the coordinates that the program writes. With tool tip control they are the tip's in the
// stock's frame. Without it they are X, Y and Z of the machine, counted from the stock's zero (as with the
// rotary axes at zero), and all joints run evenly. In both cases the rotary axes turn evenly from start to
// end.
struct MachineBlock {
    bool tip_control = false;
    Vec3 start_mm, end_mm;
    // The curve from start to end, if it is not straight; in the program's coordinates too. The quadratic's
    // axis is of no meaning.
    std::optional<Arc> arc;
    std::optional<Quadratic> quadratic;
    Vec3 start_rad, end_rad;
};

// Where the block is at the fraction t, 0..1.
Joints joints_at(const Kinematics& machine, const MachineBlock& block, double t);
ToolPose pose_at(const Kinematics& machine, const MachineBlock& block, double t);

// Appends the block as moves that join end to start, each with the words of `like` and its share of the
// duration that `like` may have; a feed move with a duration gets the feed of its tip. A block that keeps its
// rotary axes stays one straight move or arc, turned with the part; one that turns them becomes quadratic
// pieces within the tolerance, or one straight move where the axis runs along a great circle evenly. Whether
// `most` moves were enough: beyond them the rest of the block is left out.
bool append_moves(const Kinematics& machine, const MachineBlock& block, const Move& like,
                  const PieceTolerance& tolerance, std::size_t most, std::vector<Move>& moves);

}  // namespace tribo::motion
