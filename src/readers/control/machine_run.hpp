// SPDX-License-Identifier: MIT
// Runs the blocks of a program of any control on a machine: its kinematics with the tool in the spindle, and
// a record of blocks beyond its limits.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "motion/machine/kinematics.hpp"
#include "motion/machine/machine_path.hpp"

namespace tribo::readers {

class MachineRun {
  public:
    // `machine` must be accepted by motion::check; it is copied.
    explicit MachineRun(const motion::Machine& machine);

    const motion::Machine& machine() const { return machine_; }
    const motion::Kinematics& kinematics() const { return kinematics_; }
    bool has_axis(char word) const { return kinematics_.has_axis(word); }

    // Sets the tool length from the spindle nose; absent: the length of the machine definition.
    void set_tool_length(std::optional<double> length_mm);
    // The zero of the coordinates goes with the part as its axes turn, wherever it lies on them (Haas G254,
    // Fanuc G54.2: the control knows where). Travel is not checked then.
    void let_zero_turn(bool turns);
    bool zero_turns() const { return zero_turns_; }
    // True when the position of the tip at these rotary values depends on a tool length that is not known.
    bool needs_tool_length(Vec3 rotary_rad) const;

    // Upper limit of the moves of one block (300 MB).
    static constexpr std::size_t kMostPieces = 1'000'000;
    // Returns the block as moves (motion::append_moves), valid until the next call. Null: they would be more
    // than `most` or kMostPieces. Records overtravel and turns near singular positions.
    const std::vector<motion::Move>* run(const motion::MachineBlock& block, const motion::Move& like,
                                         std::size_t most);
    // Cause and remedy of the error in this case.
    static constexpr const char* kTooManyPieces =
        "its rotary axes turn too far for one move: it would become more moves than fit";
    static constexpr const char* kFewerPieces = "split it, or correct its rotary words";
    // A warning: on a machine that turns its table, parallel axes would lead the tool elsewhere.
    static constexpr const char* kParallelInTiltedPlane =
        "U, V or W does not stand at 0 while the plane tilts: its way stays along the axes of the stock";

    // Returns warnings: axes beyond their travel or speed, turns near a singular position, and a tip faster
    // than any machine, each with its first line.
    Warnings findings(const std::string& source) const;

  private:
    struct Excess {
        int first_line = 0, worst_line = 0;
        motion::Overtravel worst;
    };
    void check_travel(const motion::Joints& joints, int line);
    void check_turn(const motion::MachineBlock& block, int line);
    void check_speed(const motion::MachineBlock& block, int line);
    void add_rushes(const std::string& source, Warnings& warnings) const;

    motion::Machine given_, machine_;  // as described, and as the coordinates see it
    bool zero_turns_ = false;
    double length_mm_ = 0;
    motion::Kinematics kinematics_;
    motion::Kinematics longer_;  // with a tool of 1 mm, to find out whether the length matters
    bool length_known_ = false;
    std::vector<motion::Move> moves_;  // of the last block
    std::array<Excess, 12> excess_;    // of X Y Z A B C, below and above their travel
    // A speed above what is possible.
    struct Rush {
        int first_line = 0, worst_line = 0;
        double worst = 0;
        void take(double speed, int line);
    };
    std::array<Rush, 3> rush_;  // of A B C, rad/s
    Rush tip_rush_;             // mm/min
    int turning_blocks_ = 0;    // at feed
    double largest_word_rad_ = 0;
    int singular_line_ = 0, singular_blocks_ = 0;
    double singular_joints_rad_ = 0, singular_axis_rad_ = 0;
};

}  // namespace tribo::readers
