// SPDX-License-Identifier: MIT
// A machine that runs a program of any control: its kinematics with the tool that is in the spindle, and what
// it was asked to do beyond its means.
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
    // Of a machine that motion::check accepts; it is copied.
    explicit MachineRun(const motion::Machine& machine);

    const motion::Machine& machine() const { return machine_; }
    const motion::Kinematics& kinematics() const { return kinematics_; }
    bool has_axis(char word) const { return kinematics_.has_axis(word); }

    // The tool's length from the spindle nose from now on; absent: the machine's own.
    void set_tool_length(std::optional<double> length_mm);
    // Whether the tip's place with these rotary values depends on a tool length that nobody has given.
    bool needs_tool_length(Vec3 rotary_rad) const;

    // One block may become so many moves at most: 300 MB of them.
    static constexpr std::size_t kMostPieces = 1'000'000;
    // The block as moves (motion::append_moves), good until the next call; null: they would be more than
    // `most` or kMostPieces. Keeps what it asks of the machine.
    const std::vector<motion::Move>* run(const motion::MachineBlock& block, const motion::Move& like,
                                         std::size_t most);
    // What to say then.
    static constexpr const char* kTooManyPieces =
        "its rotary axes turn too far for one move: it would become more moves than fit";
    static constexpr const char* kFewerPieces = "split it, or correct its rotary words";

    // Axes that went beyond their travel and turns near a singular position, each with its first line.
    Warnings findings(const std::string& source) const;

  private:
    struct Excess {
        int first_line = 0, worst_line = 0;
        motion::Overtravel worst;
    };
    void check_travel(const motion::Joints& joints, int line);
    void check_turn(const motion::MachineBlock& block, int line);

    motion::Machine machine_;
    motion::Kinematics kinematics_;
    motion::Kinematics longer_;  // with a tool of 1 mm, to tell whether length matters
    bool length_known_ = false;
    std::vector<motion::Move> moves_;  // of the last block
    std::array<Excess, 12> excess_;    // of X Y Z A B C, below and above
    int singular_line_ = 0, singular_blocks_ = 0;
    double singular_joints_rad_ = 0, singular_axis_rad_ = 0;
};

}  // namespace tribo::readers
