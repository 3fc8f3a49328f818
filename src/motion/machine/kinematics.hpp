// SPDX-License-Identifier: MIT
// Converts joint values to the tool's pose in the stock, and back. The machine is one chain from the part to
// the tool, a product of displacements (product of exponentials, Brockett 1984). The two rotary angles of an
// orientation come from the second of Paden's subproblems (Paden 1986), in closed form. Any thread; only the
// constructor allocates.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "motion/machine/machine.hpp"
#include "motion/path/program.hpp"

namespace tribo::motion {

// The joints that reach a pose.
struct Reached {
    Joints joints;
    // The tool lies along the rotary axis nearest to the part. The angle of this axis has no meaning then; it
    // keeps its value.
    bool singular = false;
    bool within_limits = true;  // of the rotary axes
};

// A value of an axis beyond its travel.
struct Overtravel {
    char word = 'X';
    double value = 0, limit = 0;  // mm or rad
};

class Kinematics {
  public:
    // For a machine that check() accepts; the length is from the spindle nose to the tip, mm.
    explicit Kinematics(const Machine& machine, double tool_length_mm = 0);

    ToolPose pose(const Joints& joints) const;
    // Returns the tool's axis alone; X, Y and Z do not matter.
    Vec3 axis(Vec3 rotary_rad) const;
    // Returns where a direction of the machine, fixed to the tool's side, points in the stock.
    Vec3 direction(Vec3 in_machine, Vec3 rotary_rad) const;
    // Returns the turn of the head about the tool's axis (ToolPose).
    double turn_rad(Vec3 rotary_rad) const;
    // Returns the joints that bring the tip to this point with these rotary values.
    Joints with_tip(Vec3 tip_in_stock_mm, Vec3 rotary_rad) const;

    // Returns the joints for a pose. Among the (at most two) solutions and their whole turns it prefers those
    // within the limits, then the one that turns the axes least from `near`. Returns nothing if no angle
    // gives the axis, to 1e-6.
    std::optional<Reached> joints(const ToolPose& pose_in_stock, const Joints& near) const;

    // Lists the axes beyond their travel, in the order from the part to the tool. Returns their number.
    int overtravel(const Joints& joints, std::array<Overtravel, 6>& found) const;

    bool has_axis(char word) const;
    // True if, without tool tip control, rotary axes move the tip by a lever that depends on the tool's
    // length.
    bool turns_head() const { return turns_head_; }
    // Returns the position of the tip in the stock's frame at X0 Y0 Z0 with the rotary axes at zero.
    // Coordinates of a program without tool tip control start from this point.
    Vec3 stock_mm() const { return stock_mm_; }

  private:
    // One displacement of the chain: the motion of the tool against the part, for a growing word, along
    // `direction` or right-handed about it.
    struct Factor {
        int word = 0;  // 0 to 5: X Y Z A B C
        Vec3 direction, pivot_mm;
        double zero = 0, min = 0, max = 0;
        bool turns() const { return word >= 3; }
        double value(const Joints& j) const { return word < 3 ? j.linear_mm[word] : j.rotary_rad[word - 3]; }
    };
    struct Turn {
        double outer = 0, inner = 0;
        bool free = false;
    };
    void add(const MachineAxis& axis, double sign, Vec3 shift);
    int solve_turns(Vec3 axis, std::array<Turn, 2>& turns) const;
    double nearest_turn(const Factor& factor, double angle_rad, double near, bool& within) const;

    std::array<Factor, 6> factors_;  // from the part to the tool
    int count_ = 0;
    std::array<int, 2> rotary_{};  // index into factors_, the one nearer to the part first
    int rotary_count_ = 0;
    Vec3 stock_mm_;
    bool turns_head_ = false;
};

}  // namespace tribo::motion
