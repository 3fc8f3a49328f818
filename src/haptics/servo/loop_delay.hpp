// SPDX-License-Identifier: MIT
// Delay of arm, driver and connection: readings and forces arrive late. A delayed wall returns more energy
// than it received, and no passivity observer can prevent that in time. Two measures help: the force is
// computed for a predicted position of the hand, and the stiffness is limited by the damping of hand and arm.
#pragma once

#include <vector>

#include "base/vec3.hpp"

namespace tribo::haptics {

// Damping of a hand with a stylus held like a pen, and of the arm, N s/mm (same as in HandModel).
inline constexpr double kHandDamping = 0.02;
inline constexpr double kMostDelayS = 0.02;

// Largest passive wall stiffness: K <= b / (T/2 + delay), N/mm (Colgate and Schenkel 1997; with delay:
// Diolaiti, Niemeyer, Barbagli and Salisbury 2006). `delay_s` >= 0: round trip.
double passive_stiffness_n_per_mm(double tick_s, double delay_s, double damping_n_s_per_mm = kHandDamping);

// Predicts the position of the hand when the current force arrives. One thread; at() is real-time safe.
class HandPredictor {
  public:
    HandPredictor(double tick_s, double delay_s);
    // `position_mm`: reading of this tick. Without delay it is returned unchanged.
    Vec3 at(Vec3 position_mm) noexcept;

  private:
    double ahead_ticks_ = 0;
    std::vector<Vec3> past_;  // ring buffer of the last positions
    std::size_t next_ = 0, known_ = 0;
};

}  // namespace tribo::haptics
