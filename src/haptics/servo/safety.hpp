// SPDX-License-Identifier: MIT
// Safety guard: the last stage before the motors. It limits every rendered force.
//
//   The force never exceeds the limit of the device. The clamp scales the vector and keeps its direction.
//   The force never rises faster than the slew limit (change of the vector per tick).
//   The force rises from zero over a ramp, at the start and after every fault.
//   On a fault the force falls to half in the same tick and to zero in the next. Then only damping remains.
//
// Faults: no new reading for 5 ms, no new simulation state for 250 ms, a tick 50 ms late or earlier than the
// one before, a number that is not finite, a hand that is too fast, an arm that refuses. docs/servo.md lists
// the tests.
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
    double max_force_n = 3.3;  // > 0
    double slew_n_per_ms = 2;  // for rising forces; a fault falls faster
    double ramp_s = 0.5;       // 0: full force at once
    double tick_s = 1e-3;      // servo period; a late tick may not change the force by more than a normal one
    double max_speed_mm_per_s = 1500;   // more is a fault
    double damping_n_s_per_mm = 0.002;  // during a fault
    double device_silent_s = 5e-3;
    double simulation_stalled_s = 0.25;
    double clock_jump_s = 0.05;
    double quiet_s = 0.1;  // a fault ends after this time without its cause
};

struct SafetyInput {
    double now_s = 0;             // servo time
    double device_s = 0;          // time of the last new reading
    double simulation_s = 0;      // time of the last simulation state
    Vec3 velocity_mm_per_s;       // of the hand
    Vec3 wanted_n;                // requested force on the hand
    bool device_refused = false;  // the arm has switched its motors off
};

// One thread; real-time safe.
class SafetyGuard {
  public:
    explicit SafetyGuard(const SafetyLimits& limits) : limits_(limits) {}

    // Returns the force to send: finite and within the limits.
    Vec3 tick(const SafetyInput& input) noexcept;
    // The current fault; none while a force is allowed.
    Fault fault() const { return fault_; }
    // Number of faults of this kind so far.
    std::uint32_t count(Fault fault) const { return counts_[static_cast<int>(fault)]; }
    // Gain of the ramp: 0 after the start and after a fault, then rising to 1.
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
    Vec3 sent_, spring_;  // the last force; the last force without damping
    std::uint32_t counts_[kFaultKinds] = {};
};

}  // namespace tribo::haptics
