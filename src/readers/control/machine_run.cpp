// SPDX-License-Identifier: MIT
#include "readers/control/machine_run.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers {
namespace {

constexpr std::string_view kWords = "XYZABC";
// Travel is checked at steps of this turn of a block: no joint moves far between two of them.
constexpr double kTravelStepRad = 5 * math::kRadPerDeg;
constexpr int kMostTravelSteps = 1000;
// A block turns near a singular position if its rotary axes turn at least by kSingularTurnRad, and
// kSingularRatio times as far as the tool axis.
constexpr double kSingularTurnRad = 10 * math::kRadPerDeg;
constexpr double kSingularRatio = 10;

// If a millimetre of tool length moves the tip by less than this, the tip does not depend on the length, mm.
constexpr double kNoLever = 1e-9;

double largest_turn(const motion::MachineBlock& block) {
    const Vec3 turn = block.end_rad - block.start_rad;
    return std::max({std::abs(turn.x), std::abs(turn.y), std::abs(turn.z)});
}

std::string amount(char word, double value) {
    return word <= 'C' ? short_decimal(value * math::kDegPerRad) + " deg" : short_decimal(value) + " mm";
}

}  // namespace

MachineRun::MachineRun(const motion::Machine& machine)
    : machine_(machine),
      kinematics_(machine, machine.tool_length_mm.value_or(0)),
      longer_(machine, 1),
      length_known_(machine.tool_length_mm.has_value()) {}

bool MachineRun::needs_tool_length(Vec3 rotary_rad) const {
    if (length_known_ || !kinematics_.turns_head()) return false;
    const motion::Joints joints{{}, rotary_rad};
    return distance(kinematics_.pose(joints).tip_mm, longer_.pose(joints).tip_mm) > kNoLever;
}

void MachineRun::set_tool_length(std::optional<double> length_mm) {
    if (!length_mm) length_mm = machine_.tool_length_mm;
    length_known_ = length_mm.has_value();
    kinematics_ = motion::Kinematics(machine_, length_mm.value_or(0));
}

const std::vector<motion::Move>* MachineRun::run(const motion::MachineBlock& block, const motion::Move& like,
                                                 std::size_t most) {
    moves_.clear();
    if (!motion::append_moves(kinematics_, block, like, {}, std::min(most, kMostPieces), moves_))
        return nullptr;
    const int steps =
        std::clamp(static_cast<int>(std::ceil(largest_turn(block) / kTravelStepRad)), 1, kMostTravelSteps);
    for (int i = 0; i <= steps; ++i) {
        check_travel(motion::joints_at(kinematics_, block, static_cast<double>(i) / steps), like.line);
    }
    if (block.tip_control && like.kind == motion::MoveKind::feed) check_turn(block, like.line);
    return &moves_;
}

void MachineRun::check_travel(const motion::Joints& joints, int line) {
    std::array<motion::Overtravel, 6> found;
    const int count = kinematics_.overtravel(joints, found);
    for (int i = 0; i < count; ++i) {
        const motion::Overtravel& over = found[static_cast<std::size_t>(i)];
        const bool above = over.value > over.limit;
        Excess& excess = excess_[2 * kWords.find(over.word) + (above ? 1 : 0)];
        if (excess.first_line == 0) excess.first_line = line;
        const bool less = above ? over.value <= excess.worst.value : over.value >= excess.worst.value;
        if (excess.worst_line != 0 && less) continue;
        excess.worst_line = line;
        excess.worst = over;
    }
}

void MachineRun::check_turn(const motion::MachineBlock& block, int line) {
    const double joints = largest_turn(block);
    if (joints < kSingularTurnRad) return;
    double tool = 0;
    Vec3 before = kinematics_.axis(block.start_rad);
    constexpr int steps = 8;
    for (int i = 1; i <= steps; ++i) {
        const Vec3 axis =
            kinematics_.axis(lerp(block.start_rad, block.end_rad, static_cast<double>(i) / steps));
        tool += motion::angle_rad(before, axis);
        before = axis;
    }
    if (joints < kSingularRatio * tool) return;
    ++singular_blocks_;
    if (singular_line_ != 0) return;
    singular_line_ = line;
    singular_joints_rad_ = joints;
    singular_axis_rad_ = tool;
}

Warnings MachineRun::findings(const std::string& source) const {
    Warnings warnings;
    for (const Excess& excess : excess_) {
        if (excess.first_line == 0) continue;
        const char word = excess.worst.word;
        std::string text = std::string(1, word) + " travels beyond its limit of " +
                           amount(word, excess.worst.limit) + ", as far as " +
                           amount(word, excess.worst.value);
        if (excess.worst_line != excess.first_line) text += " on line " + std::to_string(excess.worst_line);
        warnings.push_back({source, excess.first_line, std::move(text)});
    }
    if (singular_line_ != 0) {
        std::string text = "near a singular position of the machine: a rotary axis turns " +
                           short_decimal(singular_joints_rad_ * math::kDegPerRad) +
                           " deg while the tool turns " +
                           short_decimal(singular_axis_rad_ * math::kDegPerRad) + " deg";
        if (singular_blocks_ > 1) text += " (" + std::to_string(singular_blocks_) + " such moves in all)";
        warnings.push_back({source, singular_line_, std::move(text)});
    }
    return warnings;
}

}  // namespace tribo::readers
