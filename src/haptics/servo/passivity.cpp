// SPDX-License-Identifier: MIT
#include "haptics/servo/passivity.hpp"

#include <algorithm>

namespace tribo::haptics {
namespace {

// A force on a hand that stands or comes is whole while the hand has been given no more than the first, N mm,
// and nothing once it has been given the second: a wall stays far below, a force from nowhere does not.
constexpr double kFree = 0.05, kSpent = 0.1;
// A hand that is given no more than this does not leave, N mm/s: it comes to rest, or slides.
constexpr double kAtRest = 1;
// What was reduced comes back over this time, s. At once, it would push the hand away again.
constexpr double kBackS = 4e-3;

}  // namespace

PassivityController::PassivityController(double resolution_mm, int delay_ticks, double tick_s)
    : play_(0.5 * resolution_mm),
      tick_s_(tick_s),
      sent_(static_cast<std::size_t>(std::max(delay_ticks, 0)) + 1) {}

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
    if (!touching && !under_way) {
        energy_ = leaving_ = 0;
        share_ = 1;
    }
    const double work = dot(force_n, moved);
    leaving_ = std::max(0.0, leaving_ + work - kAtRest * tick_s_);
    const bool leaves = work > 0 && leaving_ > 0;
    const double fits = leaves ? std::max(energy_, 0.0) / work : (kSpent + energy_) / (kSpent - kFree);
    const double share = std::clamp(fits, 0.0, 1.0);
    share_ = std::min(share, share_ + tick_s_ / (tick_s_ + kBackS) * (share - share_));
    const Vec3 sent = share_ * force_n;
    sent_[oldest_] = sent;
    oldest_ = (oldest_ + 1) % sent_.size();
    return sent;
}

}  // namespace tribo::haptics
