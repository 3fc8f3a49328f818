// SPDX-License-Identifier: MIT
// Devices without hardware. SimulatedHand and PointerDevice yield to forces and follow a stroke or a pointer.
// PlaybackHand follows a stroke exactly. DelayedHand adds the delay of an arm to any device.
#pragma once

#include <memory>
#include <vector>

#include "base/hand_over.hpp"
#include "haptics/contact/stroke.hpp"
#include "haptics/device/device.hpp"

namespace tribo::haptics {

// Hand, grip and arm as one mass. A spring and a damper pull it along the stroke. The defaults lie in the
// range measured for a stylus held like a pen (0.1 to 0.5 kg; hundreds of N/m). They are slightly overdamped,
// so that a tap does not ring.
struct HandModel {
    double mass_kg = 0.25;
    double stiffness_n_per_mm = 0.3;
    double damping_n_s_per_mm = 0.02;
};

// The mass, moved by the spring to the target of the hand and by the rendered force.
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

// Deterministic: each tick advances the time by tick_s.
class SimulatedHand final : public Device {
  public:
    // tick_s > 0: duration of a tick.
    SimulatedHand(Stroke stroke, double tick_s, const HandModel& model = {});

    const DeviceLimits& limits() const override { return kSimulatedLimits; }
    bool has_motors() const override { return false; }
    // The position one tick after the last reading.
    DeviceState read(HandReading& reading) noexcept override;
    // Sets the force until the next reading.
    DeviceState write(Vec3 force_n) noexcept override;
    double now_s() const { return now_s_; }

  private:
    Stroke stroke_;
    double tick_s_, now_s_;
    HandBody body_;
    Vec3 force_;
    std::uint64_t sequence_ = 0;
};

// Driven by a pointer: a mouse, a touch screen or a tracked controller. Pointer positions come at any time
// and may jump. The target of the hand follows them at kAimMmPerS at most.
class PointerDevice final : public Device {
  public:
    static constexpr double kAimMmPerS = 500;

    PointerDevice(Vec3 start_mm, double tick_s, const HandModel& model = {});

    // Called from one other thread, at any time. A position that is not finite is ignored.
    void set_target(Vec3 aim_mm);

    const DeviceLimits& limits() const override { return kSimulatedLimits; }
    bool has_motors() const override { return false; }
    // The mass does yield. But no person holds it, so no energy can reach a hand.
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

// The probe follows the stroke exactly. Forces do not move it.
class PlaybackHand final : public Device {
  public:
    PlaybackHand(Stroke stroke, double tick_s);

    const DeviceLimits& limits() const override { return kPlaybackLimits; }
    bool has_motors() const override { return false; }
    bool yields() const override { return false; }
    DeviceState read(HandReading& reading) noexcept override;
    DeviceState write(Vec3) noexcept override { return DeviceState::ready; }

  private:
    Stroke stroke_;
    double tick_s_, start_s_;
    std::uint64_t sequence_ = 0;
};

// A device behind a slow connection: readings and forces arrive some ticks late.
class DelayedHand final : public Device {
  public:
    // `delay_ticks` >= 0: round trip. Half of it delays the readings.
    DelayedHand(std::unique_ptr<Device> hand, int delay_ticks);

    const DeviceLimits& limits() const override { return hand_->limits(); }
    bool has_motors() const override { return hand_->has_motors(); }
    bool yields() const override { return hand_->yields(); }
    DeviceState read(HandReading& reading) noexcept override;
    DeviceState write(Vec3 force_n) noexcept override;

  private:
    std::unique_ptr<Device> hand_;
    std::vector<HandReading> readings_;  // ring buffers; the index is the next entry
    std::vector<Vec3> forces_;
    std::size_t reading_ = 0, force_ = 0;
    bool begun_ = false;
};

}  // namespace tribo::haptics
