// SPDX-License-Identifier: MIT
// Hands without an arm: one that yields to what it feels, and one that goes exactly where it was told.
#pragma once

#include "haptics/device.hpp"
#include "haptics/stroke.hpp"

namespace tribo::haptics {

// Hand, grip and arm as one mass that a spring and a damper pull along the stroke. The defaults lie in the
// range measured for a stylus held like a pen (a tenth to half a kilogram; hundreds of N/m), a little over
// critically damped so that a tap does not ring.
struct HandModel {
    double mass_kg = 0.25;
    double stiffness_n_per_mm = 0.3;
    double damping_n_s_per_mm = 0.02;
};

// Deterministic: time comes from outside, a tick at a time.
class SimulatedHand final : public Device {
  public:
    // tick_s > 0: what every tick lasts.
    SimulatedHand(Stroke stroke, double tick_s, const HandModel& model = {});

    const DeviceLimits& limits() const override { return kSimulatedLimits; }
    bool has_motors() const override { return false; }
    // Where the hand is now, a tick after the last reading.
    DeviceState read(HandReading& reading) noexcept override;
    // The force until the next reading.
    DeviceState write(Vec3 force_n) noexcept override;
    double now_s() const { return now_s_; }

  private:
    Stroke stroke_;
    double tick_s_, now_s_;
    double mass_, stiffness_, damping_;  // N s^2/mm, N/mm, N s/mm
    Vec3 position_, velocity_, force_;
    std::uint64_t sequence_ = 0;
};

// The probe stands on the stroke, whatever pushes it.
class PlaybackHand final : public Device {
  public:
    PlaybackHand(Stroke stroke, double tick_s);

    const DeviceLimits& limits() const override { return kSimulatedLimits; }
    bool has_motors() const override { return false; }
    bool yields() const override { return false; }
    DeviceState read(HandReading& reading) noexcept override;
    DeviceState write(Vec3) noexcept override { return DeviceState::ready; }

  private:
    Stroke stroke_;
    double tick_s_, start_s_;
    std::uint64_t sequence_ = 0;
};

}  // namespace tribo::haptics
