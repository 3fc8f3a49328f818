// SPDX-License-Identifier: MIT
// One tick of the loop between hand and world: read the arm, ask what is felt there, keep it passive and
// safe, send it. No clock and no thread of its own: whoever has them calls tick() at the servo's rate.
#pragma once

#include <cstdint>

#include "haptics/device/device.hpp"
#include "haptics/servo/loop_delay.hpp"
#include "haptics/servo/passivity.hpp"
#include "haptics/servo/safety.hpp"

namespace tribo::haptics {

struct RenderedForce {
    Vec3 contact_n;           // of surfaces, friction and their texture: kept passive
    Vec3 driven_n;            // of the machine (the cutting force): work is its business
    bool touching = false;    // a surface pushes or the cut is felt
    double simulation_s = 0;  // how new the state is that this was rendered from, servo's clock
};

// What is felt at a place. One thread; real-time safe.
class ForceSource {
  public:
    virtual ~ForceSource() = default;
    // `now_s` on the servo's clock, `tick_s` since the last call; the hand is where it will be when it feels
    // it.
    virtual RenderedForce render(const HandReading& hand, double now_s, double tick_s) noexcept = 0;
};

struct ServoTick {
    double now_s = 0;
    Vec3 position_mm;
    Vec3 force_n;  // what the hand feels
    bool touching = false;
    Fault fault = Fault::none;
};

// One thread; real-time safe. Device and source must outlive it.
class Servo {
  public:
    // `delay_s`: of arm, driver and line, both ways together, 0 to kMostDelayS.
    Servo(Device& device, ForceSource& source, const SafetyLimits& limits, double delay_s = 0);

    // `now_s`: when this tick happens, on a clock that only runs forward (if it does not, that is a fault).
    ServoTick tick(double now_s) noexcept;

    const SafetyGuard& safety() const { return safety_; }
    const PassivityController& passivity() const { return passivity_; }
    std::uint64_t ticks() const { return ticks_; }
    double max_force_n() const { return max_force_; }
    // False once the device is gone: there is nobody to send a force to.
    bool device_there() const { return device_there_; }

  private:
    Device& device_;
    ForceSource& source_;
    SafetyGuard safety_;
    PassivityController passivity_;
    HandAhead ahead_;
    HandReading hand_;
    std::uint64_t ticks_ = 0;
    double device_s_ = 0, last_now_s_ = 0, max_force_ = 0;
    bool device_there_ = true, refused_ = false;
};

}  // namespace tribo::haptics
