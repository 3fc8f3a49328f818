// SPDX-License-Identifier: MIT
// Smooth spindle angle for sound, interpolated between the few given targets.
#pragma once

#include <cstdint>

namespace tribo::sound {

// Angle in rad over one quantum, as a polynomial of the frame 0 ... 64 in it.
struct PhasePiece {
    double c0 = 0, c1 = 0, c2 = 0, c3 = 0;

    double at(double frame) const { return c0 + frame * (c1 + frame * (c2 + frame * c3)); }
    double slope(double frame) const { return c1 + frame * (2 * c2 + frame * 3 * c3); }
};

// Cubic phase interpolation with angle and rate at both ends (McAulay and Quatieri 1986, section IV). If the
// given angles are the integral of a linear rate, the interpolated rate is linear too. Whole turns missing
// from an angle do not matter. Angle and rate never jump while `sounding`.
// Rates are in rad per quantum. Real-time safe.
class SpindlePhase {
  public:
    // The spindle is at `angle` with `rate` after `quanta` >= 0 quanta. In silence the angle is exact. While
    // `sounding`, an angle that does not fit is approached smoothly.
    void set_target(double angle, double rate, std::int64_t quanta, bool sounding);
    // Discards the target: the next set_target() takes effect at once, with its rate.
    void forget() { has_target_ = false; }
    // The next quantum.
    PhasePiece advance();

  private:
    // Least number of quanta (43 ms) for the full correction of an angle: half a turn changes the rate by at
    // most 18 Hz. Shorter segments correct only a part.
    static constexpr double kLeastCorrection = 32;

    double c_[4] = {0, 0, 0, 0};                 // angle over quanta since the segment began
    std::int64_t length_ = 0, elapsed_ = 0;      // of the segment, quanta
    double target_angle_ = 0, target_rate_ = 0;  // at the end of the segment
    bool has_target_ = false;
};

}  // namespace tribo::sound
