// SPDX-License-Identifier: MIT
// The rotation of a spindle from sample to sample, with its sine and cosine.
#pragma once

#include <cmath>
#include <cstddef>

#include "base/math.hpp"
#include "dynamics/step/tool_place.hpp"

namespace tribo::dynamics {

// The same angle in the first turn.
inline double in_turn(double angle_rad) {
    return angle_rad - math::kTwoPi * std::floor(angle_rad / math::kTwoPi);
}

// One thread, real-time safe.
class SpindleTurn {
  public:
    explicit SpindleTurn(double rotation_rad)
        : rotation_rad_(rotation_rad), turn_rad_(in_turn(rotation_rad)) {
        refresh();
    }

    // From a sample to the next one.
    void set_step(double step_rad) {
        step_rad_ = step_rad;
        double sine, cosine;
        math::sincos(step_rad, sine, cosine);
        step_ = {sine, cosine};
    }
    double step_rad() const { return step_rad_; }

    double rotation_rad() const { return rotation_rad_; }  // of all turns
    double turn_rad() const { return turn_rad_; }          // of this one
    D2 sine_cosine() const { return sine_cosine_; }

    void advance() {
        constexpr unsigned kFreshEvery = 256;  // samples after which sine and cosine are computed anew
        rotation_rad_ += step_rad_;
        turn_rad_ += step_rad_;
        if (turn_rad_ >= math::kTwoPi) turn_rad_ -= math::kTwoPi;
        if (++since_fresh_ == kFreshEvery) {
            since_fresh_ = 0;
            refresh();
        } else {
            sine_cosine_ = step_(sine_cosine_);
        }
    }

  private:
    void refresh() {
        double sine, cosine;
        math::sincos(turn_rad_, sine, cosine);
        sine_cosine_ = D2{sine, cosine};
    }

    double rotation_rad_, turn_rad_, step_rad_ = 0;
    D2 sine_cosine_{};
    Turner step_{0, 1};
    unsigned since_fresh_ = 0;
};

}  // namespace tribo::dynamics
