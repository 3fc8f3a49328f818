// SPDX-License-Identifier: MIT
#include "haptics/servo/loop_delay.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tribo::haptics {
namespace {

// The speed is taken over so long: an encoder's steps of 0.01 mm are 5 mm/s of it.
constexpr double kSpeedOverS = 2e-3;
// Once the lag would make up for what is lost on the way in; half as much again also for the speed's own lag.
constexpr double kLead = 1.5;

}  // namespace

double passive_stiffness_n_per_mm(double tick_s, double delay_s, double damping) {
    assert(tick_s > 0 && delay_s >= 0 && damping > 0);
    return damping / (0.5 * tick_s + delay_s);
}

HandPredictor::HandPredictor(double tick_s, double delay_s) {
    assert(tick_s > 0 && delay_s >= 0);
    if (delay_s <= 0) return;
    ahead_ticks_ = kLead * (delay_s / tick_s + 0.5);
    past_.resize(static_cast<std::size_t>(std::max(1.0, std::round(kSpeedOverS / tick_s))));
}

Vec3 HandPredictor::at(Vec3 position) noexcept {
    if (past_.empty()) return position;
    const std::size_t count = past_.size();
    if (known_ == 0) past_[next_] = position;
    const Vec3 oldest = known_ < count ? past_[0] : past_[next_];
    const auto ticks = static_cast<double>(std::max<std::size_t>(known_, 1));
    past_[next_] = position;
    next_ = (next_ + 1) % count;
    known_ = std::min(known_ + 1, count);
    return position + (ahead_ticks_ / ticks) * (position - oldest);
}

}  // namespace tribo::haptics
