// SPDX-License-Identifier: MIT
// A wall that is sampled gives back more energy than it took: the force of a tick stands still while the hand
// moves on. The observer adds up what the hand has put in (Hannaford and Ryu 2002, time-domain passivity
// observer); the controller lets the force give back only that: where the hand leaves and the work of the
// next tick would be more than is left, the force is less. It never adds a force, so a coarse encoder cannot
// make it kick, as damping by a noisy speed does. Only what touches may be counted: a cutting force is the
// machine's own work. Where the loop has a delay (loop_delay.hpp), a motion is paid for by the force that the
// hand felt in it, which was sent as much earlier.
#pragma once

#include <vector>

#include "base/vec3.hpp"

namespace tribo::haptics {

// One thread; real-time safe.
class PassivityController {
  public:
    // The step of the device's positions, >= 0. Places are observed with as much play: where a position only
    // flickers between two steps nothing has moved.
    // `delay_ticks` >= 0: both ways together.
    explicit PassivityController(double resolution_mm = 0, int delay_ticks = 0);

    // The force to send instead of `force_n` in this tick. `touching`: the surface pushes at all; energy that
    // friction swallowed in one contact is no credit for the next.
    Vec3 tick(Vec3 force_n, Vec3 position_mm, bool touching) noexcept;

    // What the hand has put in and not got back since the contact began, N mm.
    double energy_nmm() const { return energy_; }
    // The lowest that it ever was.
    double lowest_energy_nmm() const { return lowest_; }

  private:
    double play_;
    bool started_ = false;
    Vec3 place_;
    std::vector<Vec3> sent_;  // a ring of the forces whose motion has not been seen
    std::size_t oldest_ = 0;
    double energy_ = 0, lowest_ = 0;
};

}  // namespace tribo::haptics
