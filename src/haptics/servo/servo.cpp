// SPDX-License-Identifier: MIT
#include "haptics/servo/servo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo::haptics {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Servo::Servo(Device& device, ForceSource& source, const SafetyLimits& limits, double delay_s)
    : device_(device),
      source_(source),
      safety_(limits),
      passivity_(device.limits().resolution_mm, static_cast<int>(std::round(delay_s / limits.tick_s)),
                 limits.tick_s),
      // A hand that does not yield stands where it was told, however late.
      ahead_(limits.tick_s, device.yields() ? delay_s : 0) {}

ServoTick Servo::tick(double now_s) noexcept {
    const bool first = ticks_ == 0;
    const std::uint64_t known = hand_.sequence;
    const DeviceState state = device_.read(hand_);
    if (state == DeviceState::gone) device_connected_ = false;
    refused_ = refused_ || state == DeviceState::refused;
    // A device that never spoke has been silent since before the start.
    if (hand_.sequence != known) device_s_ = now_s;
    if (first && hand_.sequence == known) device_s_ = now_s - 2 * safety_.limits().device_silent_s;

    const double period = safety_.limits().tick_s;
    const double step_s = first ? period : std::clamp(now_s - last_now_s_, 0.0, 2 * period);
    RenderedForce felt;
    felt.simulation_s = now_s;
    Vec3 wanted{kNotANumber, kNotANumber, kNotANumber};  // the guard's business
    if (is_finite(hand_.position_mm) && is_finite(hand_.velocity_mm_per_s)) {
        HandReading ahead = hand_;
        ahead.position_mm = ahead_.at(hand_.position_mm);
        felt = source_.render(ahead, now_s, step_s);
        // A hand that does not yield cannot be pushed: there is nothing to keep passive. A force from afar
        // counts as a contact.
        const bool pushes = felt.touching || felt.contact_n != Vec3{};
        wanted =
            felt.driven_n +
            (device_.yields() ? passivity_.tick(felt.contact_n, hand_.position_mm, pushes) : felt.contact_n);
    }
    ServoTick tick;
    tick.now_s = now_s;
    tick.position_mm = hand_.position_mm;
    tick.force_n =
        safety_.tick({now_s, device_s_, felt.simulation_s, hand_.velocity_mm_per_s, wanted, refused_});
    tick.fault = safety_.fault();
    tick.touching = felt.touching;
    const DeviceState taken = device_connected_ ? device_.write(tick.force_n) : DeviceState::gone;
    if (taken == DeviceState::gone) device_connected_ = false;
    refused_ = taken != DeviceState::ready;  // whatever the reason, the hand does not feel this force
    max_force_ = std::max(max_force_, length(tick.force_n));
    last_now_s_ = now_s;
    ++ticks_;
    return tick;
}

}  // namespace tribo::haptics
