// SPDX-License-Identifier: MIT
#include "motion/machine/machine_path.hpp"

#include <cmath>

#include "motion/algebra/direction.hpp"
#include "motion/algebra/quadratic_cut.hpp"
#include "motion/path/path.hpp"

namespace tribo::motion {
namespace {

// Share of the tolerance within which a block that turns its axes still counts as one straight move.
constexpr double kStraightShare = 0.01;

// Returns the program's coordinates at t: along the line or the arc.
Vec3 coordinates_at(const MachineBlock& block, double t) {
    Move move;
    move.start.tip_mm = block.start_mm;
    move.end.tip_mm = block.end_mm;
    move.arc = block.arc;
    move.quadratic = block.quadratic;
    return pose_at(move, t).tip_mm;
}

Vec3 rotary_at(const MachineBlock& block, double t) {
    return t >= 1 ? block.end_rad : lerp(block.start_rad, block.end_rad, t);
}

// Returns the block with its rotary axes at rest: their effect on its coordinates is one displacement.
Move rigid_move(const Kinematics& machine, const MachineBlock& block, const Move& like) {
    Move move = like;
    move.start = pose_at(machine, block, 0);
    move.end = pose_at(machine, block, 1);
    move.quadratic = block.quadratic;
    move.arc = block.arc;
    const auto placed = [&](Vec3 coordinates) {
        return machine.pose({coordinates + machine.stock_mm(), block.start_rad}).tip_mm;
    };
    if (block.quadratic) {
        move.quadratic->axis_control = move.start.axis;
        if (!block.tip_control) move.quadratic->tip_control_mm = placed(block.quadratic->tip_control_mm);
    }
    if (block.arc && !block.tip_control) {
        move.arc->centre_mm = placed(block.arc->centre_mm);
        move.arc->normal = placed(block.arc->centre_mm + block.arc->normal) - move.arc->centre_mm;
    }
    return move;
}

// Returns true if one straight move along a great circle equals the block at the parameters where pieces are
// checked.
bool is_straight(const Kinematics& machine, const MachineBlock& block, const Move& straight,
                 const PieceTolerance& tolerance) {
    if (block.arc || block.quadratic || dot(straight.start.axis, straight.end.axis) < 0) return false;
    const auto holds = [&](double t) {
        const ToolPose is = pose_at(straight, t), should = pose_at(machine, block, t);
        return distance(is.tip_mm, should.tip_mm) <= kStraightShare * tolerance.tip_mm &&
               distance(is.axis, should.axis) <= kStraightShare * tolerance.axis_rad;
    };
    return holds(0.5) && std::all_of(kChecked.begin(), kChecked.end(), holds);
}

void finish(Move& move, double share, double whole_s) {
    if (!(whole_s > 0)) return;
    move.duration_s = share * whole_s;
    if (move.kind == MoveKind::feed) move.feed_mm_per_min = 60 * path_length_mm(move) / move.duration_s;
}

}  // namespace

Joints joints_at(const Kinematics& machine, const MachineBlock& block, double t) {
    const Vec3 coordinates = coordinates_at(block, t), rotary = rotary_at(block, t);
    if (block.tip_control) return machine.with_tip(coordinates, rotary);
    return {coordinates + machine.stock_mm(), rotary};
}

ToolPose pose_at(const Kinematics& machine, const MachineBlock& block, double t) {
    const Vec3 coordinates = coordinates_at(block, t), rotary = rotary_at(block, t);
    const double turn = machine.turn_rad(rotary);
    if (block.tip_control) return {coordinates, normalized(machine.axis(rotary)), turn};
    ToolPose pose = machine.pose({coordinates + machine.stock_mm(), rotary});
    pose.axis = normalized(pose.axis);
    pose.turn_rad = turn;
    return pose;
}

bool append_moves(const Kinematics& machine, const MachineBlock& block, const Move& like,
                  const PieceTolerance& tolerance, std::size_t most, std::vector<Move>& moves) {
    if (most == 0) return false;
    const double whole_s = like.duration_s;
    const Vec3 turn = block.end_rad - block.start_rad;
    const double largest = std::max({std::abs(turn.x), std::abs(turn.y), std::abs(turn.z)});
    const Move rigid = rigid_move(machine, block, like);
    if (largest == 0 || (largest < kMaxPieceTurnRad && is_straight(machine, block, rigid, tolerance))) {
        moves.push_back(rigid);
        finish(moves.back(), 1, whole_s);
        return true;
    }
    const auto pose_of = [&](double t) { return pose_at(machine, block, t); };
    const std::size_t full = moves.size() + most;
    const auto sink = [&](const Move& piece, double a, double b) {
        if (moves.size() == full) return false;
        moves.push_back(piece);
        finish(moves.back(), b - a, whole_s);
        return true;
    };
    const QuadraticCut cut(pose_of, like, tolerance, sink);
    // The spans are so short that a sample cannot be confused with the same pose a whole turn away.
    const double arc_turn = block.arc ? std::abs(block.arc->turn_rad) : 0;
    const int spans = static_cast<int>(std::ceil(std::max(largest, arc_turn) / kMaxPieceTurnRad));
    ToolPose start = pose_of(0);
    for (int i = 0; i < spans; ++i) {
        const double a = static_cast<double>(i) / spans, b = static_cast<double>(i + 1) / spans;
        const ToolPose end = pose_of(b);
        if (!cut.cut(a, start, b, end)) return false;
        start = end;
    }
    return true;
}

}  // namespace tribo::motion
