// SPDX-License-Identifier: MIT
// Hands without an arm: two that yield to what they feel, along a stroke or led from outside, and one that
// goes exactly where it was told; and the delay of an arm, for any of them.
#pragma once

#include <memory>
#include <vector>

#include "base/hand_over.hpp"
#include "haptics/contact/stroke.hpp"
#include "haptics/device/device.hpp"

namespace tribo::haptics {

// Hand, grip and arm as one mass that a spring and a damper pull along the stroke. The defaults lie in the
// range measured for a stylus held like a pen (a tenth to half a kilogram; hundreds of N/m), a little over
// critically damped so that a tap does not ring.
struct HandModel {
    double mass_kg = 0.25;
    double stiffness_n_per_mm = 0.3;
    double damping_n_s_per_mm = 0.02;
};

// The mass between the pull of the hand's aim and the force that it feels.
class HandBody {
  public:
    HandBody(Vec3 position_mm, double tick_s, const HandModel& model);
    void step(Vec3 aim_mm, Vec3 aim_mm_per_s, Vec3 force_n) noexcept;
    Vec3 position_mm() const { return position_; }
    Vec3 velocity_mm_per_s() const { return velocity_; }

  private:
    double tick_s_, mass_, stiffness_, damping_;  // s, N s^2/mm, N/mm, N s/mm
    Vec3 position_, velocity_;
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
    HandBody body_;
    Vec3 force_;
    std::uint64_t sequence_ = 0;
};

// Led by a pointer of whatever kind, whose places come when they come: the hand's aim goes there at
// kAimMmPerS at most, as a mouse may jump and a hand may not.
class LedHand final : public Device {
  public:
    static constexpr double kAimMmPerS = 500;

    LedHand(Vec3 start_mm, double tick_s, const HandModel& model = {});

    // From one other thread, at any time; not finite: nothing changes.
    void lead_to(Vec3 aim_mm);

    const DeviceLimits& limits() const override { return kSimulatedLimits; }
    bool has_motors() const override { return false; }
    // It does, but no person's hand moves with it: there is nobody to keep energy from.
    bool yields() const override { return false; }
    DeviceState read(HandReading& reading) noexcept override;
    DeviceState write(Vec3 force_n) noexcept override;

  private:
    Snapshot<Vec3> goal_;
    double tick_s_;
    Vec3 aim_;
    HandBody body_;
    Vec3 force_;
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

// A device as it is at the end of a slow line: readings and forces come some ticks late.
class DelayedHand final : public Device {
  public:
    // Ticks both ways together, >= 0: half of them before a reading comes.
    DelayedHand(std::unique_ptr<Device> hand, int delay_ticks);

    const DeviceLimits& limits() const override { return hand_->limits(); }
    bool has_motors() const override { return hand_->has_motors(); }
    bool yields() const override { return hand_->yields(); }
    DeviceState read(HandReading& reading) noexcept override;
    DeviceState write(Vec3 force_n) noexcept override;

  private:
    std::unique_ptr<Device> hand_;
    std::vector<HandReading> readings_;  // rings; the next to come is at the index
    std::vector<Vec3> forces_;
    std::size_t reading_ = 0, force_ = 0;
    bool begun_ = false;
};

}  // namespace tribo::haptics
