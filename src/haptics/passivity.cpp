// SPDX-License-Identifier: MIT
#include "haptics/passivity.hpp"

#include <algorithm>

namespace tribo::haptics {

Vec3 PassivityController::tick(Vec3 force_n, Vec3 position_mm, Vec3 velocity_mm_per_s, double tick_s,
                               bool touching) noexcept {
    if (started_) energy_ -= dot(last_force_, position_mm - last_position_);
    if (!(std::abs(energy_) < 1e12)) energy_ = 0;  // a reading that was not finite is the guard's business
    lowest_ = std::min(lowest_, energy_);
    if (!touching) energy_ = std::min(energy_, 0.0);
    const double speed2 = squared_length(velocity_mm_per_s);
    Vec3 force = force_n;
    if (energy_ < 0 && speed2 > 0) {
        const double damping = std::min(most_, -energy_ / (speed2 * tick_s));
        force -= damping * velocity_mm_per_s;
    }
    started_ = true;
    last_force_ = force;
    last_position_ = position_mm;
    return force;
}

}  // namespace tribo::haptics
