// SPDX-License-Identifier: MIT
// Joint values to the tool's pose in the stock, and back. The machine is read as one chain from the part to
// the tool, a product of displacements (product of exponentials, Brockett 1984); the two rotary angles of an
// orientation come from the second of Paden's subproblems (Paden 1986), in closed form. Any thread;
// allocates when it is made only.
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
    // The tool lies along the rotary axis nearest to the part, whose angle then means nothing: it stays.
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
    // Of a machine that check() accepts; the length from the spindle nose to the tip, mm.
    explicit Kinematics(const Machine& machine, double tool_length_mm = 0);

    ToolPose pose(const Joints& joints) const;
    // The tool's axis alone; X, Y and Z do not matter.
    Vec3 axis(Vec3 rotary_rad) const;
    // The joints that bring the tip there with these rotary values.
    Joints with_tip(Vec3 tip_in_stock_mm, Vec3 rotary_rad) const;

    // The joints for a pose: of the (at most two) solutions and their whole turns, one within the limits
    // before one beyond, then the one that turns the axes least from `near`. None where no angle gives the
    // axis, to 1e-6.
    std::optional<Reached> joints(const ToolPose& pose_in_stock, const Joints& near) const;

    // The axes beyond their travel, in the order from the part to the tool; how many they are.
    int overtravel(const Joints& joints, std::array<Overtravel, 6>& found) const;

    bool has_axis(char word) const;
    // Whether rotary axes move the tip without tool tip control by a lever that depends on the tool's length.
    bool turns_head() const { return turns_head_; }
    // Where the tip stands in the stock's frame at X0 Y0 Z0 with the rotary axes at zero: what a program's
    // coordinates without tool tip control are counted from.
    Vec3 stock_mm() const { return stock_mm_; }

  private:
    // One displacement of the chain: the tool moves against the part, for a growing word, along `direction`
    // or right-handed about it.
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
    std::array<int, 2> rotary_{};  // of factors_, the one nearer to the part first
    int rotary_count_ = 0;
    Vec3 stock_mm_;
    bool turns_head_ = false;
};

}  // namespace tribo::motion
