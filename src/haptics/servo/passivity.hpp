// SPDX-License-Identifier: MIT
// Time-domain passivity control (Hannaford and Ryu 2002). A sampled wall returns more energy than it
// received: the force is constant during a tick while the hand moves on. The observer sums the energy that
// the hand has put in. When the hand leaves and the work of the next tick would exceed this energy, the
// controller reduces the force, and gives it back within some ms: at once, a hand that comes to rest or
// slides would feel it go and come. It never adds a force, so a coarse encoder cannot cause kicks, unlike
// damping by a noisy speed. A force that has moved the hand without taking anything from it before ends, too,
// while the hand stands. Only contact forces are counted: a cutting force is work of the machine. With a
// delay (loop_delay.hpp) the observer multiplies each motion by the force that was sent one delay earlier.
#pragma once

#include <vector>

#include "base/vec3.hpp"

namespace tribo::haptics {

// One thread; real-time safe.
class PassivityController {
  public:
    // `resolution_mm` >= 0: step of the positions. The observer has the same backlash: a position that only
    // flickers between two steps counts as no motion.
    // `delay_ticks` >= 0: round trip. `tick_s` > 0.
    explicit PassivityController(double resolution_mm = 0, int delay_ticks = 0, double tick_s = 1e-3);

    // Returns the passive force to send in place of `force_n`. `touching`: the surface pushes. The energy
    // starts at 0 with every contact.
    Vec3 tick(Vec3 force_n, Vec3 position_mm, bool touching) noexcept;

    // Energy that the hand has put in and not received back since the contact began, N mm.
    double energy_nmm() const { return energy_; }
    // Lowest value of energy_nmm() so far.
    double lowest_energy_nmm() const { return lowest_; }

  private:
    double play_, tick_s_;
    bool started_ = false;
    Vec3 place_;
    std::vector<Vec3> sent_;  // ring buffer of the forces in the delay
    std::size_t oldest_ = 0;
    double energy_ = 0, lowest_ = 0;
    double leaving_ = 0;  // work beyond that of a hand at rest, N mm
    double share_ = 1;    // of the last force
};

}  // namespace tribo::haptics
