// SPDX-License-Identifier: MIT
// A wall that is sampled gives back more energy than it took: the force of a tick stands still while the hand
// moves on. The observer adds up what the hand has put in; where that falls below zero, the controller takes
// the missing energy out of the hand's speed as damping (Hannaford and Ryu 2002, time-domain passivity
// control). Only what touches may be counted: a cutting force is the machine's own work.
#pragma once

#include "base/vec3.hpp"

namespace tribo::haptics {

// One thread; real-time safe.
class PassivityController {
  public:
    // The most damping that it may add, N s/mm: what the device stays stable with.
    explicit PassivityController(double max_damping_n_s_per_mm) : most_(max_damping_n_s_per_mm) {}

    // The force to send instead of `force_n` in this tick. `touching`: the surface pushes at all; energy that
    // friction swallowed in one contact is no credit for the next.
    Vec3 tick(Vec3 force_n, Vec3 position_mm, Vec3 velocity_mm_per_s, double tick_s, bool touching) noexcept;

    // What the hand has put in and not got back since the contact began, N mm.
    double energy_nmm() const { return energy_; }
    // The lowest that it ever was.
    double lowest_energy_nmm() const { return lowest_; }

  private:
    double most_;
    bool started_ = false;
    Vec3 last_force_, last_position_;
    double energy_ = 0, lowest_ = 0;
};

}  // namespace tribo::haptics
