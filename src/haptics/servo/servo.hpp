// SPDX-License-Identifier: MIT
// One tick of the haptic loop: read the arm, render the force, keep it passive and safe, send it. No clock
// and no thread of its own: the caller calls tick() at the servo rate.
#pragma once

#include <cstdint>

#include "haptics/device/device.hpp"
#include "haptics/servo/loop_delay.hpp"
#include "haptics/servo/passivity.hpp"
#include "haptics/servo/safety.hpp"

namespace tribo::haptics {

struct RenderedForce {
    Vec3 contact_n;           // of surfaces, friction and texture: kept passive
    Vec3 driven_n;            // of the machine (the cutting force): not kept passive
    bool touching = false;    // a surface pushes or the cutting force acts
    double simulation_s = 0;  // servo time of the simulation state
};

// Renders the force at a position of the hand. One thread; real-time safe.
class ForceSource {
  public:
    virtual ~ForceSource() = default;
    // `now_s`: servo time. `tick_s`: time since the last call. `hand`: predicted for the time when the force
    // arrives.
    virtual RenderedForce render(const HandReading& hand, double now_s, double tick_s) noexcept = 0;
};

struct ServoTick {
    double now_s = 0;
    Vec3 position_mm;
    Vec3 force_n;  // force on the hand
    bool touching = false;
    Fault fault = Fault::none;
};

// One thread; real-time safe. Device and source must outlive it.
class Servo {
  public:
    // `delay_s`: round trip of arm, driver and connection, 0 to kMostDelayS.
    Servo(Device& device, ForceSource& source, const SafetyLimits& limits, double delay_s = 0);

    // `now_s`: time of this tick on a monotonic clock. A step back is a fault.
    ServoTick tick(double now_s) noexcept;

    const SafetyGuard& safety() const { return safety_; }
    const PassivityController& passivity() const { return passivity_; }
    std::uint64_t ticks() const { return ticks_; }
    double max_force_n() const { return max_force_; }
    // False after the device is gone.
    bool is_device_connected() const { return device_connected_; }

  private:
    Device& device_;
    ForceSource& source_;
    SafetyGuard safety_;
    PassivityController passivity_;
    HandPredictor ahead_;
    HandReading hand_;
    std::uint64_t ticks_ = 0;
    double device_s_ = 0, last_now_s_ = 0, max_force_ = 0;
    bool device_connected_ = true, refused_ = false;
};

}  // namespace tribo::haptics
