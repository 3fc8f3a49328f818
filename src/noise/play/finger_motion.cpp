// SPDX-License-Identifier: MIT
#include "noise/play/finger_motion.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::noise {
namespace {

// Positions closer in time than this are one report (coalesced events).
constexpr double kSameReportS = 0.002;
// Part of the speed's change that is led on. All of it would have no lag and twice the noise.
constexpr double kLead = 0.7;
constexpr double kEaseS = 0.002;
// Intervals without a report after which a finger is taken to stand, and how fast it then stops.
constexpr double kStandsAfter = 2.2;
constexpr double kStopS = 0.01;
constexpr double kShortestIntervalS = 0.004, kLongestIntervalS = 0.025;

}  // namespace

void FingerMotion::touch(double t_s, double x_mm, double y_mm, double force_n) {
    force_n_ = force_n;
    const double dt = t_s - last_s_;
    if (reports_ == 0 || dt < 0) {
        reports_ = 1;
        last_s_ = t_s;
        x_mm_ = x_mm;
        y_mm_ = y_mm;
        speed_ = rise_ = ease_ = 0;
        return;
    }
    if (dt < kSameReportS) return;
    // A finger that stood for a while moved in the last interval alone.
    const double moved_s = std::min(dt, 2 * interval_s_);
    const double speed = math::hypot(x_mm - x_mm_, y_mm - y_mm_) / moved_s;
    const double middle_s = t_s - 0.5 * moved_s;
    const double before = at(t_s).speed_mm_per_s;
    rise_ = reports_ > 1 && dt < kStandsAfter * interval_s_ ? (speed - speed_) / (middle_s - middle_s_) : 0;
    const bool moves_off = speed_ == 0;
    speed_ = speed;
    middle_s_ = middle_s;
    interval_s_ += 0.1 * (std::clamp(dt, kShortestIntervalS, kLongestIntervalS) - interval_s_);
    last_s_ = t_s;
    x_mm_ = x_mm;
    y_mm_ = y_mm;
    ++reports_;
    ease_ = moves_off ? 0 : before - led_on(t_s);
}

void FingerMotion::lift() {
    reports_ = 0;
    force_n_ = 0;
}

double FingerMotion::led_on(double t_s) const {
    const double ahead = std::min(t_s - middle_s_, 2 * interval_s_);
    return std::clamp(speed_ + kLead * rise_ * ahead, 0.0, 2 * speed_);
}

FingerMotion::State FingerMotion::at(double t_s) const {
    if (reports_ == 0) return {};
    const double since = t_s - last_s_;
    double speed = led_on(t_s) + ease_ * math::exp(-since / kEaseS);
    const double stood = since - kStandsAfter * interval_s_;
    if (stood > 0) speed *= math::exp(-stood / kStopS);
    // Below a hundredth of a millimetre a second it stands.
    return {speed > 0.01 ? speed : 0, force_n_};
}

}  // namespace tribo::noise
