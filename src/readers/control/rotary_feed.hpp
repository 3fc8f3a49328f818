// SPDX-License-Identifier: MIT
// The time of a feed move that turns rotary axes without tool tip control: each control counts the angles of
// a block in its own way (docs/machines.md). Any thread.
#pragma once

#include "base/vec3.hpp"

namespace tribo::readers {

struct RotaryFeed {
    // Length that a radian of A, B and C counts beside X, Y and Z, mm; 0: the feed does not count it.
    Vec3 mm_per_rad;
    // The length for which a degree counts where nothing else moves, mm: the unit of the program.
    double degree_mm = 1;

    // A degree counts as a unit of length in every move (Fanuc B-63174EN, 4.2; Sinumerik with all axes in
    // FGROUP).
    static RotaryFeed degrees_as_lengths(double unit_mm);
};

// Returns the time in seconds. `length_mm` is that of the way of X, Y and Z, `turn_rad` the turns of A, B and
// C; one of them is not 0. feed_mm_per_min > 0.
double turning_time_s(double length_mm, Vec3 turn_rad, double feed_mm_per_min, const RotaryFeed& rule);

}  // namespace tribo::readers
