// SPDX-License-Identifier: MIT
// Smooth transitions of level and speed. Real-time safe.
#pragma once

#include <cstdint>

#include "sound/cut/partials.hpp"

namespace tribo::sound {

// A value that moves linearly to its target.
class Ramp {
  public:
    // Reaches `to` after `quanta` >= 0 quanta.
    void set_target(double to, std::int64_t quanta) {
        from_ = value();
        to_ = to;
        length_ = quanta;
        elapsed_ = 0;
    }
    void jump_to(double to) {
        from_ = to_ = to;
        length_ = elapsed_ = 0;
    }
    double target() const { return to_; }
    double value() const {
        if (elapsed_ >= length_) return to_;
        return from_ + static_cast<double>(elapsed_) / static_cast<double>(length_) * (to_ - from_);
    }
    // Advances by one quantum.
    double advance() {
        if (elapsed_ < length_) ++elapsed_;
        return value();
    }

  private:
    double from_ = 0, to_ = 0;
    std::int64_t length_ = 0, elapsed_ = 0;
};

// A pressure that follows steps within 20 ms along a smooth S, and ends in exact silence.
class SmoothLevel {
  public:
    // Advances by one quantum towards `pa`. spline() then gives the level during this quantum.
    void follow(double pa) {
        constexpr double kFollow = 0.125;  // share of the remaining way per quantum, applied twice
        constexpr double kInaudiblePa = 1e-9;
        before_ = here_;
        here_ = after_;
        slow_ += kFollow * (pa - slow_);
        after_ += kFollow * (slow_ - after_);
        if (pa == 0 && after_ < kInaudiblePa && slow_ < kInaudiblePa) slow_ = after_ = 0;
    }
    Spline spline() const { return {before_, here_, after_}; }
    bool silent() const { return before_ == 0 && here_ == 0 && after_ == 0; }
    // Whether the level has ended.
    bool over() const { return here_ == 0 && after_ == 0; }

  private:
    double slow_ = 0, before_ = 0, here_ = 0, after_ = 0;
};

}  // namespace tribo::sound
