// SPDX-License-Identifier: MIT
#include "motion/machine/kinematics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"

namespace tribo::motion {
namespace {

constexpr std::string_view kWords = "XYZABC";
constexpr Vec3 kSpindle{0, 0, 1};
// A tool nearer than this to a rotary axis lies along it, rad. Also the tolerance of a reachable axis.
constexpr double kSingular = 1e-6;
// Tolerance of a joint limit, for rounding, mm or rad.
constexpr double kLimitSlack = 1e-9;

// Returns the angle about `about` from a to b, both projected on the plane normal to it, -pi..pi.
double angle_about(Vec3 about, Vec3 a, Vec3 b) {
    const Vec3 u = a - dot(a, about) * about, v = b - dot(b, about) * about;
    return math::atan2(dot(about, cross(u, v)), dot(u, v));
}

double from_line(Vec3 u, Vec3 about) {
    return length(cross(u, about));
}

double overshoot(double value, double min, double max) {
    return std::max({0.0, min - value, value - max});
}

}  // namespace

Kinematics::Kinematics(const Machine& machine, double tool_length_mm)
    : stock_mm_(machine.stock_mm), turns_head_(machine.turns_head()) {
    assert(check(machine));
    for (auto axis = machine.part_side.rbegin(); axis != machine.part_side.rend(); ++axis) add(*axis, -1, {});
    for (const MachineAxis& axis : machine.tool_side) add(axis, 1, tool_length_mm * kSpindle);
}

void Kinematics::add(const MachineAxis& axis, double sign, Vec3 shift) {
    Factor& factor = factors_[static_cast<std::size_t>(count_)];
    factor.word = static_cast<int>(kWords.find(axis.word));
    factor.direction = sign * axis.direction;
    factor.pivot_mm = axis.pivot_mm + shift;
    factor.zero = axis.zero;
    factor.min = axis.min;
    factor.max = axis.max;
    if (factor.turns()) rotary_[static_cast<std::size_t>(rotary_count_++)] = count_;
    ++count_;
}

ToolPose Kinematics::pose(const Joints& joints) const {
    ToolPose pose{{}, kSpindle};
    for (int i = count_ - 1; i >= 0; --i) {
        const Factor& f = factors_[static_cast<std::size_t>(i)];
        const double value = f.value(joints) - f.zero;
        if (f.turns()) {
            pose.tip_mm = f.pivot_mm + turned(pose.tip_mm - f.pivot_mm, f.direction, value);
            pose.axis = turned(pose.axis, f.direction, value);
        } else {
            pose.tip_mm += value * f.direction;
        }
    }
    pose.tip_mm -= stock_mm_;
    return pose;
}

// A direction of the tool's side, seen from the part.
Vec3 Kinematics::direction(Vec3 in_machine, Vec3 rotary_rad) const {
    Vec3 direction = in_machine;
    for (int i = rotary_count_ - 1; i >= 0; --i) {
        const Factor& f = factors_[static_cast<std::size_t>(rotary_[static_cast<std::size_t>(i)])];
        direction = turned(direction, f.direction, rotary_rad[f.word - 3] - f.zero);
    }
    return direction;
}

Vec3 Kinematics::axis(Vec3 rotary_rad) const {
    return direction(kSpindle, rotary_rad);
}

double Kinematics::turn_rad(Vec3 rotary_rad) const {
    const Vec3 axis = normalized(this->axis(rotary_rad));
    return angle_about(axis, turned_upright({1, 0, 0}, axis), direction({1, 0, 0}, rotary_rad));
}

Joints Kinematics::with_tip(Vec3 tip_in_stock_mm, Vec3 rotary_rad) const {
    // The tip is an affine function of X, Y and Z: its value at zero and its three columns.
    Joints joints{{}, rotary_rad};
    const Vec3 missing = tip_in_stock_mm - pose(joints).tip_mm;
    std::array<Vec3, 3> column;
    for (int i = 0; i < count_; ++i) {
        const Factor& f = factors_[static_cast<std::size_t>(i)];
        if (f.turns()) continue;
        Vec3 direction = f.direction;
        for (int k = i - 1; k >= 0; --k) {
            const Factor& outer = factors_[static_cast<std::size_t>(k)];
            if (outer.turns())
                direction = turned(direction, outer.direction, outer.value(joints) - outer.zero);
        }
        column[static_cast<std::size_t>(f.word)] = direction;
    }
    const double volume = dot(cross(column[0], column[1]), column[2]);
    joints.linear_mm =
        Vec3{dot(cross(column[1], column[2]), missing), dot(cross(column[2], column[0]), missing),
             dot(cross(column[0], column[1]), missing)} /
        volume;
    return joints;
}

// Computes the angles of the rotary factors, relative to their zeros, that give the axis. Returns the number
// of solutions.
int Kinematics::solve_turns(Vec3 axis, std::array<Turn, 2>& turns) const {
    if (rotary_count_ == 0) return distance(axis, kSpindle) <= kSingular ? 1 : 0;
    const Vec3 inner =
        factors_[static_cast<std::size_t>(rotary_[static_cast<std::size_t>(rotary_count_ - 1)])].direction;
    const double reach = dot(inner, kSpindle);
    if (rotary_count_ == 1) {
        if (std::abs(dot(inner, axis) - reach) > kSingular) return 0;
        turns[0].inner = angle_about(inner, kSpindle, axis);
        return 1;
    }
    const Vec3 outer = factors_[static_cast<std::size_t>(rotary_[0])].direction;
    // v is the axis between the two turns: dot(v, outer) = dot(axis, outer) and dot(v, inner) = reach.
    const double along = dot(outer, inner), height = dot(axis, outer), rest = 1 - along * along;
    const double a = (height - along * reach) / rest, b = (reach - along * height) / rest;
    double square = (1 - a * a - b * b - 2 * a * b * along) / rest;
    if (square < -2 * kSingular) return 0;
    square = std::max(square, 0.0);
    const bool free = from_line(axis, outer) <= kSingular;
    const int count = square > 0 && !free ? 2 : 1;
    // Along the outer axis one inner angle is enough; if rounding leaves two, any of them.
    for (int i = 0; i < count; ++i) {
        const double side = i == 0 ? std::sqrt(square) : -std::sqrt(square);
        const Vec3 v = free ? axis : a * outer + b * inner + side * cross(outer, inner);
        turns[static_cast<std::size_t>(i)] = {free ? 0 : angle_about(outer, v, axis),
                                              angle_about(inner, kSpindle, v), free};
    }
    return count;
}

// Returns the value of the axis at the angle plus whole turns: within the limits if possible, then nearest to
// `near`.
double Kinematics::nearest_turn(const Factor& f, double angle_rad, double near, bool& within) const {
    const double value = f.zero + angle_rad;
    double best = value + math::kTwoPi * std::floor((near - value) / math::kTwoPi + 0.5);
    if (overshoot(best, f.min, f.max) > kLimitSlack) {
        // The nearest one is outside: search inwards from the limit that it passed.
        const double inside =
            best > f.max ? value + math::kTwoPi * std::floor((f.max + kLimitSlack - value) / math::kTwoPi)
                         : value + math::kTwoPi * std::ceil((f.min - kLimitSlack - value) / math::kTwoPi);
        if (overshoot(inside, f.min, f.max) <= kLimitSlack) best = inside;
    }
    within = within && overshoot(best, f.min, f.max) <= kLimitSlack;
    return best;
}

std::optional<Reached> Kinematics::joints(const ToolPose& pose_in_stock, const Joints& near) const {
    std::array<Turn, 2> turns;
    const int count = solve_turns(pose_in_stock.axis, turns);
    std::optional<Reached> best;
    double best_way = 0;
    for (int i = 0; i < count; ++i) {
        const Turn& turn = turns[static_cast<std::size_t>(i)];
        Reached reached{near, turn.free, true};
        double way = 0;
        for (int k = 0; k < rotary_count_; ++k) {
            const Factor& f = factors_[static_cast<std::size_t>(rotary_[static_cast<std::size_t>(k)])];
            double& value = reached.joints.rotary_rad[f.word - 3];
            const double before = value;
            if (k == 0 && turn.free) continue;
            value = nearest_turn(f, k + 1 == rotary_count_ ? turn.inner : turn.outer, before,
                                 reached.within_limits);
            way += std::abs(value - before);
        }
        if (best && (best->within_limits > reached.within_limits ||
                     (best->within_limits == reached.within_limits && best_way <= way)))
            continue;
        best = reached;
        best_way = way;
    }
    if (best) {
        const Joints joints = with_tip(pose_in_stock.tip_mm, best->joints.rotary_rad);
        best->joints.linear_mm = joints.linear_mm;
    }
    return best;
}

int Kinematics::overtravel(const Joints& joints, std::array<Overtravel, 6>& found) const {
    int count = 0;
    for (int i = 0; i < count_; ++i) {
        const Factor& f = factors_[static_cast<std::size_t>(i)];
        const double value = f.value(joints);
        if (overshoot(value, f.min, f.max) <= kLimitSlack) continue;
        found[static_cast<std::size_t>(count++)] = {kWords[static_cast<std::size_t>(f.word)], value,
                                                    value < f.min ? f.min : f.max};
    }
    return count;
}

bool Kinematics::has_axis(char word) const {
    return std::any_of(factors_.begin(), factors_.begin() + count_,
                       [&](const Factor& f) { return kWords[static_cast<std::size_t>(f.word)] == word; });
}

}  // namespace tribo::motion
