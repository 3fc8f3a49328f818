// SPDX-License-Identifier: MIT
#include "readers/control/machine_run.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"
#include "motion/path/path.hpp"
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

// No tip of a mill feeds faster over a part, mm/min; no rotary axis turns faster at a feed, rad/s (200 rpm:
// direct drives). Beyond it words or kinematics are wrong.
constexpr double kFastestTip = 100'000;
constexpr double kFastestTurn = 200 * math::kTwoPi / 60;
// Rounding of a feed that was computed from the limit.
constexpr double kSpeedSlack = 1.001;
// Programs that turn in so many blocks and whose largest word lies between these, degrees, may mean radians:
// a quarter turn to a whole one.
constexpr int kManyTurns = 20;
constexpr double kLeastRadians = 1.5, kMostRadians = 6.3;

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
    : given_(machine),
      machine_(machine),
      length_mm_(machine.tool_length_mm.value_or(0)),
      kinematics_(machine, length_mm_),
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
    length_mm_ = length_mm.value_or(0);
    kinematics_ = motion::Kinematics(machine_, length_mm_);
}

void MachineRun::let_zero_turn(bool turns) {
    zero_turns_ = turns;
    machine_ = given_;
    if (turns) {  // as if the part stood with its zero on the axes that carry it
        machine_.stock_mm = {};
        for (motion::MachineAxis& axis : machine_.part_side) axis.pivot_mm = {};
    }
    kinematics_ = motion::Kinematics(machine_, length_mm_);
    longer_ = motion::Kinematics(machine_, 1);
}

const std::vector<motion::Move>* MachineRun::run(const motion::MachineBlock& block, const motion::Move& like,
                                                 std::size_t most) {
    moves_.clear();
    if (!motion::append_moves(kinematics_, block, like, {}, std::min(most, kMostPieces), moves_))
        return nullptr;
    const int steps =
        std::clamp(static_cast<int>(std::ceil(largest_turn(block) / kTravelStepRad)), 1, kMostTravelSteps);
    for (int i = 0; i <= steps && !zero_turns_; ++i) {
        check_travel(motion::joints_at(kinematics_, block, static_cast<double>(i) / steps), like.line);
    }
    if (block.tip_control && like.kind == motion::MoveKind::feed) check_turn(block, like.line);
    if (like.kind == motion::MoveKind::feed) check_speed(block, like.line);
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

void MachineRun::Rush::take(double speed, int line) {
    if (first_line == 0) first_line = line;
    if (speed <= worst) return;
    worst = speed;
    worst_line = line;
}

// For a block at feed whose moves are in moves_.
void MachineRun::check_speed(const motion::MachineBlock& block, int line) {
    const Vec3 turn = block.end_rad - block.start_rad;
    if (turn == Vec3{}) return;
    ++turning_blocks_;
    for (int k = 0; k < 3; ++k) {
        largest_word_rad_ =
            std::max({largest_word_rad_, std::abs(block.start_rad[k]), std::abs(block.end_rad[k])});
    }
    double whole_s = 0, fastest = 0;
    for (const motion::Move& move : moves_) {
        const double way_mm = motion::path_length_mm(move);
        const double time_s = move.duration_s > 0 ? move.duration_s : 60 * way_mm / move.feed_mm_per_min;
        whole_s += time_s;
        if (time_s > 0) fastest = std::max(fastest, 60 * way_mm / time_s);
    }
    if (fastest > kFastestTip) tip_rush_.take(fastest, line);
    for (int k = 0; k < 3 && whole_s > 0; ++k) {
        const motion::MachineAxis* axis = machine_.axis("ABC"[k]);
        const double speed = std::abs(turn[k]) / whole_s;
        const double limit = axis == nullptr ? kFastestTurn : std::min(axis->max_speed, kFastestTurn);
        if (speed > limit * kSpeedSlack) rush_[static_cast<std::size_t>(k)].take(speed, line);
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

void MachineRun::add_rushes(const std::string& source, Warnings& warnings) const {
    const auto at_worst = [](const Rush& rush, const std::string& speed) {
        return rush.worst_line == rush.first_line
                   ? ""
                   : " (at worst " + speed + " on line " + std::to_string(rush.worst_line) + ")";
    };
    for (std::size_t k = 0; k < rush_.size(); ++k) {
        const Rush& rush = rush_[k];
        if (rush.first_line == 0) continue;
        const motion::MachineAxis* axis = machine_.axis(kWords[3 + k]);
        const double limit = axis == nullptr ? kFastestTurn : std::min(axis->max_speed, kFastestTurn);
        const std::string speed = short_decimal(rush.worst * 60 * math::kDegPerRad, 0) + " deg/min";
        warnings.push_back({source, rush.first_line,
                            std::string("the feed turns ") + kWords[3 + k] + " faster than the " +
                                short_decimal(limit * 60 * math::kDegPerRad, 0) + " deg/min that " +
                                (axis != nullptr && axis->max_speed <= kFastestTurn
                                     ? "the machine " + machine_.name + " allows"
                                     : "any machine turns at a feed") +
                                ": there it runs slower than is computed here; at most " + speed +
                                at_worst(rush, speed)});
    }
    if (tip_rush_.first_line != 0) {
        const std::string speed = short_decimal(tip_rush_.worst / 1000, 0) + " m/min";
        warnings.push_back(
            {source, tip_rush_.first_line,
             "at this feed the tip runs over the part at up to " + speed + at_worst(tip_rush_, speed) +
                 ", faster than any machine: check the machine's axes and pivots, and the unit of F"});
    }
    const bool may_be_radians = turning_blocks_ >= kManyTurns &&
                                largest_word_rad_ > kLeastRadians * math::kRadPerDeg &&
                                largest_word_rad_ <= kMostRadians * math::kRadPerDeg;
    if (may_be_radians) {
        warnings.push_back(
            {source, 0,
             "no rotary word is larger than " + short_decimal(largest_word_rad_ * math::kDegPerRad) +
                 ": words count degrees; if these are radians, let the CAM system write degrees"});
    }
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
    add_rushes(source, warnings);
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
