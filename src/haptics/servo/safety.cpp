// SPDX-License-Identifier: MIT
#include "haptics/servo/safety.hpp"

#include <algorithm>

namespace tribo::haptics {
namespace {

// As much of the direction as the size allows.
Vec3 clamped(Vec3 v, double most) {
    const double size = length(v);
    return size > most ? (most / size) * v : v;
}

// Speeds and forces beyond these are noise of a broken device or model; squares of them still are numbers.
constexpr double kAbsurd = 1e9;
// No hand is faster, mm/s: then a wrong position is behind it.
constexpr double kFastestHand = 5000;

bool is_sane(Vec3 v) {
    return std::abs(v.x) < kAbsurd && std::abs(v.y) < kAbsurd && std::abs(v.z) < kAbsurd;
}

}  // namespace

const char* name(Fault fault) {
    switch (fault) {
        case Fault::none:
            return "none";
        case Fault::device_silent:
            return "device silent";
        case Fault::simulation_stalled:
            return "simulation stalled";
        case Fault::clock_jump:
            return "clock jump";
        case Fault::not_finite:
            return "not finite";
        case Fault::too_fast:
            return "too fast";
        case Fault::device_refused:
            return "device refused";
    }
    return "none";
}

Fault SafetyGuard::find_fault(const SafetyInput& in) const {
    const double step_s = in.now_s - last_now_s_;
    // Written so that a time that is not a number is a jump too.
    if (started_ && !(step_s >= 0 && step_s <= limits_.clock_jump_s)) return Fault::clock_jump;
    if (!is_sane(in.wanted_n) || !is_sane(in.velocity_mm_per_s)) return Fault::not_finite;
    if (!(in.now_s - in.device_s <= limits_.device_silent_s)) return Fault::device_silent;
    // What comes back on by itself comes back by the ramp.
    if (in.device_refused) return Fault::device_refused;
    if (!(in.now_s - in.simulation_s <= limits_.simulation_stalled_s)) return Fault::simulation_stalled;
    // Once it is too fast it has to become half as fast.
    const double most =
        fault_ == Fault::too_fast ? 0.5 * limits_.max_speed_mm_per_s : limits_.max_speed_mm_per_s;
    if (length(in.velocity_mm_per_s) > most) return Fault::too_fast;
    return Fault::none;
}

Vec3 SafetyGuard::slewed(Vec3 wanted) const {
    return sent_ + clamped(wanted - sent_, limits_.slew_n_per_ms * limits_.tick_s * 1e3);
}

Vec3 SafetyGuard::faulty(const SafetyInput& in, Fault now) {
    spring_ = fault_ticks_ == 0 ? 0.5 * spring_ : Vec3{};
    const Vec3 damping_before = fault_ticks_ == 0 ? Vec3{} : sent_;
    ++fault_ticks_;
    // A device that is silent or jumps and a clock that jumped do not know how fast the hand is.
    const bool speed_known = now != Fault::device_silent && now != Fault::clock_jump &&
                             length(in.velocity_mm_per_s) <= kFastestHand;
    if (fault_ticks_ == 1 || !speed_known) return spring_;
    const double most = limits_.slew_n_per_ms * limits_.tick_s * 1e3;
    const Vec3 damping = clamped(-limits_.damping_n_s_per_mm * in.velocity_mm_per_s, limits_.max_force_n);
    return fault_ticks_ == 2 ? clamped(damping, most)
                             : damping_before + clamped(damping - damping_before, most);
}

Vec3 SafetyGuard::tick(const SafetyInput& in) noexcept {
    const Fault now = find_fault(in);
    const bool jumped = now == Fault::clock_jump;
    if (now != Fault::none) {
        if (fault_ == Fault::none) fault_ticks_ = 0;
        if (fault_ != now) ++counts_[static_cast<int>(now)];
        fault_ = now;
        fault_end_s_ = in.now_s + limits_.quiet_s;
        gain_ = 0;
    }
    if (!started_) gain_ = 0;
    if (fault_ != Fault::none && (now != Fault::none || in.now_s < fault_end_s_)) {
        sent_ = faulty(in, now);
    } else {
        fault_ = Fault::none;
        const double step_s = started_ && !jumped ? std::min(in.now_s - last_now_s_, limits_.tick_s) : 0;
        gain_ = limits_.ramp_s > 0 ? std::min(1.0, gain_ + step_s / limits_.ramp_s) : 1;
        sent_ = spring_ =
            clamped(slewed(clamped(gain_ * in.wanted_n, limits_.max_force_n)), limits_.max_force_n);
    }
    started_ = true;
    last_now_s_ = in.now_s;
    return sent_;
}

}  // namespace tribo::haptics
