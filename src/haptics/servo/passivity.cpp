// SPDX-License-Identifier: MIT
#include "haptics/servo/passivity.hpp"

#include <algorithm>

namespace tribo::haptics {
namespace {

// A force on a hand that stands or comes is whole while the hand has been given no more than the first, N mm,
// and nothing once it has been given the second: a wall stays far below, a force from nowhere does not.
constexpr double kFree = 0.05, kSpent = 0.1;

}  // namespace

PassivityController::PassivityController(double resolution_mm, int delay_ticks)
    : play_(0.5 * resolution_mm), sent_(static_cast<std::size_t>(std::max(delay_ticks, 0)) + 1) {}

Vec3 PassivityController::tick(Vec3 force_n, Vec3 position_mm, bool touching) noexcept {
    if (!started_) place_ = position_mm;
    started_ = true;
    const Vec3 away = position_mm - place_;
    const double far = length(away);
    const Vec3 moved = far > play_ ? ((far - play_) / far) * away : Vec3{};
    place_ += moved;
    energy_ -= dot(sent_[oldest_], moved);
    lowest_ = std::min(lowest_, energy_);
    sent_[oldest_] = {};
    const bool under_way = std::any_of(sent_.begin(), sent_.end(), [](Vec3 f) { return f != Vec3{}; });
    if (!touching && !under_way) energy_ = std::min(energy_, 0.0);
    const double work = dot(force_n, moved), left = std::max(energy_, 0.0);
    const double owed = std::clamp((kSpent + energy_) / (kSpent - kFree), 0.0, 1.0);
    const Vec3 sent = (work > left ? left / work : owed) * force_n;
    sent_[oldest_] = sent;
    oldest_ = (oldest_ + 1) % sent_.size();
    return sent;
}

}  // namespace tribo::haptics
