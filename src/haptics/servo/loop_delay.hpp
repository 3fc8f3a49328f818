// SPDX-License-Identifier: MIT
// What an arm, its driver and its line add to the loop: the hand was read a while ago, and what is sent is
// felt a while later. A wall that lags behind the hand gives back more than it took, however it is watched.
// Two things keep it from that: the force is rendered for where the hand will be, and the wall is no stiffer
// than the damping of hand and arm bears.
#pragma once

#include <vector>

#include "base/vec3.hpp"

namespace tribo::haptics {

// Of a hand that holds an arm's stylus like a pen, and of the arm, N s/mm (HandModel's).
inline constexpr double kHandDamping = 0.02;
inline constexpr double kMostDelayS = 0.02;

// The stiffest wall that gains no energy: K <= b / (T/2 + delay), N/mm (Colgate and Schenkel 1997; with delay
// Diolaiti, Niemeyer, Barbagli and Salisbury 2006). `delay_s`: both ways together, >= 0.
double passive_stiffness_n_per_mm(double tick_s, double delay_s, double damping_n_s_per_mm = kHandDamping);

// Where a hand will be when it feels what is rendered now. One thread; at() is real-time safe.
class HandAhead {
  public:
    HandAhead(double tick_s, double delay_s);
    // `position_mm`: as read in this tick. Without delay it is what is returned.
    Vec3 at(Vec3 position_mm) noexcept;

  private:
    double ahead_ticks_ = 0;
    std::vector<Vec3> past_;  // a ring of the last places
    std::size_t next_ = 0, known_ = 0;
};

}  // namespace tribo::haptics
