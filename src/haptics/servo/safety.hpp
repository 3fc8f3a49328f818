// SPDX-License-Identifier: MIT
// The last stage before the motors: whatever the rendering wants, this is what the hand may get.
//
//   never above the device's force; the clamp scales the vector, so its direction stays
//   never rising faster than the slew limit (the change of the vector over a tick)
//   from zero over the ramp, at the start and after every fault
//   on a fault: half of the last force in that tick, zero in the next, then nothing but damping
//
// Faults: no new reading for 5 ms, no new state of the simulation for 250 ms, a tick that comes 50 ms late or
// before the one it follows, a number that is not finite, a hand that is too fast, an arm that refuses.
// docs/servo.md says how each is tested.
#pragma once

#include <cstdint>

#include "base/vec3.hpp"

namespace tribo::haptics {

enum class Fault : std::uint8_t {
    none,
    device_silent,
    simulation_stalled,
    clock_jump,
    not_finite,
    too_fast,
    device_refused,
};
inline constexpr int kFaultKinds = 7;
const char* name(Fault fault);

struct SafetyLimits {
    double max_force_n = 3.3;           // > 0
    double slew_n_per_ms = 2;           // of a rise; a fault's fall is faster
    double ramp_s = 0.5;                // 0: full force at once
    double tick_s = 1e-3;               // the servo's period; a late tick may not change the force by more
    double max_speed_mm_per_s = 1500;   // of the hand; above: a fault
    double damping_n_s_per_mm = 0.002;  // while a fault lasts
    double device_silent_s = 5e-3;
    double simulation_stalled_s = 0.25;
    double clock_jump_s = 0.05;
    double quiet_s = 0.1;  // a fault is over after so long without its cause
};

struct SafetyInput {
    double now_s = 0;             // of the servo's clock
    double device_s = 0;          // when the device last said something new, same clock
    double simulation_s = 0;      // when the simulation last handed over a state
    Vec3 velocity_mm_per_s;       // of the hand
    Vec3 wanted_n;                // on the hand
    bool device_refused = false;  // the arm has switched its motors off, or may
};

// One thread; real-time safe.
class SafetyGuard {
  public:
    explicit SafetyGuard(const SafetyLimits& limits) : limits_(limits) {}

    // The force that may be sent: finite, within the limits.
    Vec3 tick(const SafetyInput& input) noexcept;
    // What is wrong now; none while force is given.
    Fault fault() const { return fault_; }
    // How often each fault began.
    std::uint32_t count(Fault fault) const { return counts_[static_cast<int>(fault)]; }
    // 0 after the start and after a fault, 1 once the ramp is over.
    double gain() const { return gain_; }
    const SafetyLimits& limits() const { return limits_; }

  private:
    Fault find_fault(const SafetyInput& input) const;
    Vec3 faulty(const SafetyInput& input, Fault now);
    Vec3 slewed(Vec3 wanted) const;

    SafetyLimits limits_;
    bool started_ = false;
    double last_now_s_ = 0, fault_end_s_ = 0, gain_ = 0;
    Fault fault_ = Fault::none;
    int fault_ticks_ = 0;
    Vec3 sent_, spring_;  // the last force; what of it was not damping
    std::uint32_t counts_[kFaultKinds] = {};
};

}  // namespace tribo::haptics
