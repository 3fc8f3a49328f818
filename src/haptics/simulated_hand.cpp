// SPDX-License-Identifier: MIT
#include "haptics/simulated_hand.hpp"

namespace tribo::haptics {
namespace {

constexpr double kKgToNs2PerMm = 1e-3;

}  // namespace

SimulatedHand::SimulatedHand(Stroke stroke, double tick_s, const HandModel& model)
    : stroke_(std::move(stroke)),
      tick_s_(tick_s),
      now_s_(stroke_.start_s()),
      mass_(model.mass_kg * kKgToNs2PerMm),
      stiffness_(model.stiffness_n_per_mm),
      damping_(model.damping_n_s_per_mm),
      position_(stroke_.at(now_s_).position_mm) {}

// Implicit Euler for spring and damper (stable at any tick), the force as it stands over the tick:
//   m (v' - v) = dt (F + k (s' - x - dt v') + b (u' - v')),   x' = x + dt v'.
DeviceState SimulatedHand::read(HandReading& reading) noexcept {
    if (sequence_ > 0) {
        now_s_ = stroke_.start_s() + static_cast<double>(sequence_) * tick_s_;
        const Stroke::At aim = stroke_.at(now_s_);
        const Vec3 push =
            force_ + stiffness_ * (aim.position_mm - position_) + damping_ * aim.velocity_mm_per_s;
        velocity_ = (mass_ * velocity_ + tick_s_ * push) /
                    (mass_ + tick_s_ * damping_ + tick_s_ * tick_s_ * stiffness_);
        position_ += tick_s_ * velocity_;
    }
    ++sequence_;
    reading.position_mm = position_;
    reading.velocity_mm_per_s = velocity_;
    reading.sequence = sequence_;
    return DeviceState::ready;
}

DeviceState SimulatedHand::write(Vec3 force_n) noexcept {
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

}  // namespace tribo::haptics
