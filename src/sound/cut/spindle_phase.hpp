// SPDX-License-Identifier: MIT
// The angle of the spindle as sound needs it: smooth between the few moments at which it is told.
#pragma once

#include <cstdint>

namespace tribo::sound {

// Angle in rad over one quantum, as a polynomial of the frame 0 ... 64 in it.
struct PhasePiece {
    double c0 = 0, c1 = 0, c2 = 0, c3 = 0;

    double at(double frame) const { return c0 + frame * (c1 + frame * (c2 + frame * c3)); }
    double slope(double frame) const { return c1 + frame * (2 * c2 + frame * 3 * c3); }
};

// Cubic interpolation of phase that meets angle and rate at both ends (McAulay and Quatieri 1986, section
// IV): when the told angle is the integral of a rate that runs linearly, so does the rate of the piece; whole
// turns missing from an angle do not matter. Neither angle nor rate ever jumps while `sounding`.
// Rates are in rad per quantum. Real-time safe.
class SpindlePhase {
  public:
    // The spindle is at `angle` with `rate` after `quanta` >= 0 quanta. Unless something sounds, what was
    // told before holds exactly; while it sounds, an angle that does not fit is approached.
    void lead(double angle, double rate, std::int64_t quanta, bool sounding);
    // What was told before no longer counts: the next lead() holds from now on, at its rate.
    void forget() { told_ = false; }
    // The next quantum.
    PhasePiece advance();

  private:
    // A wrong angle is put right over at least this many quanta (43 ms), or only in part: half a turn then
    // bends the rate by at most 18 Hz.
    static constexpr double kLeastCorrection = 32;

    double c_[4] = {0, 0, 0, 0};             // angle over quanta since the segment began
    std::int64_t length_ = 0, elapsed_ = 0;  // of the segment, quanta
    double told_angle_ = 0, told_rate_ = 0;  // at the end of the segment
    bool told_ = false;
};

}  // namespace tribo::sound
