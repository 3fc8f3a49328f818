// SPDX-License-Identifier: MIT
#include "haptics/servo/simulated_hand.hpp"

#include <algorithm>

namespace tribo::haptics {
namespace {

constexpr double kKgToNs2PerMm = 1e-3;

}  // namespace

HandBody::HandBody(Vec3 position_mm, double tick_s, const HandModel& model)
    : tick_s_(tick_s),
      mass_(model.mass_kg * kKgToNs2PerMm),
      stiffness_(model.stiffness_n_per_mm),
      damping_(model.damping_n_s_per_mm),
      position_(position_mm) {}

// Implicit Euler for spring and damper (stable at any tick), the force as it stands over the tick:
//   m (v' - v) = dt (F + k (s' - x - dt v') + b (u' - v')),   x' = x + dt v'.
void HandBody::step(Vec3 aim_mm, Vec3 aim_mm_per_s, Vec3 force_n) noexcept {
    const Vec3 push = force_n + stiffness_ * (aim_mm - position_) + damping_ * aim_mm_per_s;
    velocity_ =
        (mass_ * velocity_ + tick_s_ * push) / (mass_ + tick_s_ * damping_ + tick_s_ * tick_s_ * stiffness_);
    position_ += tick_s_ * velocity_;
}

SimulatedHand::SimulatedHand(Stroke stroke, double tick_s, const HandModel& model)
    : stroke_(std::move(stroke)),
      tick_s_(tick_s),
      now_s_(stroke_.start_s()),
      body_(stroke_.at(now_s_).position_mm, tick_s, model) {}

DeviceState SimulatedHand::read(HandReading& reading) noexcept {
    if (sequence_ > 0) {
        now_s_ = stroke_.start_s() + static_cast<double>(sequence_) * tick_s_;
        const Stroke::At aim = stroke_.at(now_s_);
        body_.step(aim.position_mm, aim.velocity_mm_per_s, force_);
    }
    reading.position_mm = body_.position_mm();
    reading.velocity_mm_per_s = body_.velocity_mm_per_s();
    reading.sequence = ++sequence_;
    return DeviceState::ready;
}

DeviceState SimulatedHand::write(Vec3 force_n) noexcept {
    force_ = force_n;
    return DeviceState::ready;
}

PointerDevice::PointerDevice(Vec3 start_mm, double tick_s, const HandModel& model)
    : goal_(start_mm), tick_s_(tick_s), aim_(start_mm), body_(start_mm, tick_s, model) {}

void PointerDevice::set_target(Vec3 aim_mm) {
    if (is_finite(aim_mm)) goal_.publish(aim_mm);
}

DeviceState PointerDevice::read(HandReading& reading) noexcept {
    const Vec3 way = goal_.read() - aim_;
    const double far = length(way), step = kAimMmPerS * tick_s_;
    const Vec3 moved = far > step ? step / far * way : way;
    aim_ += moved;
    body_.step(aim_, moved / tick_s_, force_);
    reading.position_mm = body_.position_mm();
    reading.velocity_mm_per_s = body_.velocity_mm_per_s();
    reading.sequence = ++sequence_;
    return DeviceState::ready;
}

DeviceState PointerDevice::write(Vec3 force_n) noexcept {
    force_ = force_n;
    return DeviceState::ready;
}

PlaybackHand::PlaybackHand(Stroke stroke, double tick_s)
    : stroke_(std::move(stroke)), tick_s_(tick_s), start_s_(stroke_.start_s()) {}

DeviceState PlaybackHand::read(HandReading& reading) noexcept {
    const Stroke::At at = stroke_.at(start_s_ + static_cast<double>(sequence_) * tick_s_);
    reading.position_mm = at.position_mm;
    reading.velocity_mm_per_s = at.velocity_mm_per_s;
    reading.sequence = ++sequence_;
    return DeviceState::ready;
}

DelayedHand::DelayedHand(std::unique_ptr<Device> hand, int delay_ticks)
    : hand_(std::move(hand)),
      readings_(static_cast<std::size_t>(delay_ticks / 2) + 1),
      forces_(static_cast<std::size_t>(delay_ticks - delay_ticks / 2) + 1) {}

DeviceState DelayedHand::read(HandReading& reading) noexcept {
    HandReading now = readings_[(reading_ + readings_.size() - 1) % readings_.size()];
    const DeviceState state = hand_->read(now);
    if (!begun_) std::fill(readings_.begin(), readings_.end(), now);
    begun_ = true;
    readings_[reading_] = now;
    reading_ = (reading_ + 1) % readings_.size();
    const std::uint64_t sequence = now.sequence;
    reading = readings_[reading_];
    reading.sequence = sequence;  // something comes in every tick, if old
    return state;
}

DeviceState DelayedHand::write(Vec3 force_n) noexcept {
    forces_[force_] = force_n;
    force_ = (force_ + 1) % forces_.size();
    return hand_->write(forces_[force_]);
}

}  // namespace tribo::haptics
