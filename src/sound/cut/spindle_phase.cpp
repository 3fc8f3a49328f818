// SPDX-License-Identifier: MIT
#include "sound/cut/spindle_phase.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "sound/cut/voice.hpp"

namespace tribo::sound {
namespace {

// Into [-pi, pi].
double wrapped(double angle) {
    return angle - math::kTwoPi * std::floor(angle / math::kTwoPi + 0.5);
}

}  // namespace

void SpindlePhase::set_target(double angle, double rate, std::int64_t quanta, bool sounding) {
    const double length = static_cast<double>(std::max<std::int64_t>(quanta, 1));
    const double t = static_cast<double>(elapsed_);
    double angle0 = c_[0] + t * (c_[1] + t * (c_[2] + t * c_[3]));
    double rate0 = c_[1] + t * (2 * c_[2] + t * 3 * c_[3]);
    if (!has_target_ || (quanta == 0 && !sounding)) {
        angle0 = angle - static_cast<double>(quanta) * rate;
        rate0 = rate;
    } else if (!sounding) {
        angle0 = target_angle_ + static_cast<double>(elapsed_ - length_) * target_rate_;
        rate0 = target_rate_;
    }
    const double end = quanta == 0 ? angle + rate : angle;  // of a segment of at least one quantum
    const double trapezoid = 0.5 * (rate0 + rate) * length;
    const double misfit = wrapped(end - angle0 - trapezoid);
    const double turn = trapezoid + (sounding ? misfit * std::min(1.0, length / kLeastCorrection) : misfit);
    c_[0] = wrapped(angle0);
    c_[1] = rate0;
    c_[2] = (3 * turn - length * (2 * rate0 + rate)) / (length * length);
    c_[3] = (length * (rate0 + rate) - 2 * turn) / (length * length * length);
    elapsed_ = 0;
    length_ = std::max<std::int64_t>(quanta, 1);
    target_angle_ = end;
    target_rate_ = rate;
    has_target_ = true;
}

PhasePiece SpindlePhase::advance() {
    if (elapsed_ == length_) {  // arrived: on at the last rate
        const double t = static_cast<double>(length_);
        c_[0] = wrapped(c_[0] + t * (c_[1] + t * (c_[2] + t * c_[3])));
        c_[1] = target_rate_;
        c_[2] = c_[3] = 0;
        target_angle_ = c_[0] + target_rate_;
        elapsed_ = 0;
        length_ = 1;
    }
    constexpr double kPerFrame = 1.0 / kQuantumFrames;
    const double t = static_cast<double>(elapsed_++);
    return {c_[0] + t * (c_[1] + t * (c_[2] + t * c_[3])),
            (c_[1] + t * (2 * c_[2] + t * 3 * c_[3])) * kPerFrame,
            (c_[2] + t * 3 * c_[3]) * kPerFrame * kPerFrame, c_[3] * kPerFrame * kPerFrame * kPerFrame};
}

}  // namespace tribo::sound
