// SPDX-License-Identifier: MIT
// How a voice gets from one level and speed to the next. Real-time safe.
#pragma once

#include <cstdint>

#include "sound/cut/partials.hpp"

namespace tribo::sound {

// A number that is told where to be, and when: it goes there in a straight line.
class Ramp {
  public:
    // Reaches `to` after `quanta` >= 0 quanta.
    void lead(double to, std::int64_t quanta) {
        from_ = here();
        to_ = to;
        length_ = quanta;
        elapsed_ = 0;
    }
    void leap(double to) {
        from_ = to_ = to;
        length_ = elapsed_ = 0;
    }
    double target() const { return to_; }
    double here() const {
        if (elapsed_ >= length_) return to_;
        return from_ + static_cast<double>(elapsed_) / static_cast<double>(length_) * (to_ - from_);
    }
    // A quantum on.
    double advance() {
        if (elapsed_ < length_) ++elapsed_;
        return here();
    }

  private:
    double from_ = 0, to_ = 0;
    std::int64_t length_ = 0, elapsed_ = 0;
};

// A pressure that follows steps within 20 ms, along a smooth S, and ends in exact silence.
class SmoothLevel {
  public:
    // A quantum on, towards `pa`; it is at spline() throughout that quantum.
    void follow(double pa) {
        constexpr double kFollow = 0.125;  // of what is left, per quantum, twice over
        constexpr double kInaudiblePa = 1e-9;
        before_ = here_;
        here_ = after_;
        slow_ += kFollow * (pa - slow_);
        after_ += kFollow * (slow_ - after_);
        if (pa == 0 && after_ < kInaudiblePa && slow_ < kInaudiblePa) slow_ = after_ = 0;
    }
    Spline spline() const { return {before_, here_, after_}; }
    bool silent() const { return before_ == 0 && here_ == 0 && after_ == 0; }
    // Whether nothing is to come of what was asked for.
    bool over() const { return here_ == 0 && after_ == 0; }

  private:
    double slow_ = 0, before_ = 0, here_ = 0, after_ = 0;
};

}  // namespace tribo::sound
