// SPDX-License-Identifier: MIT
#include "haptics/passivity.hpp"

#include <algorithm>

namespace tribo::haptics {

Vec3 PassivityController::tick(Vec3 force_n, Vec3 position_mm, bool touching) noexcept {
    if (!started_) place_ = position_mm;
    started_ = true;
    const Vec3 away = position_mm - place_;
    const double far = length(away);
    const Vec3 moved = far > play_ ? ((far - play_) / far) * away : Vec3{};
    place_ += moved;
    energy_ -= dot(last_force_, moved);
    lowest_ = std::min(lowest_, energy_);
    if (!touching) energy_ = std::min(energy_, 0.0);
    const double work = dot(force_n, moved), left = std::max(energy_, 0.0);
    last_force_ = work > left ? (left / work) * force_n : force_n;
    return last_force_;
}

}  // namespace tribo::haptics
