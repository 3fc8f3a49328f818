// SPDX-License-Identifier: MIT
// What is known of a cut as a whole.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/vec3.hpp"
#include "milling/engagement/chip.hpp"
#include "milling/engagement/collision.hpp"

namespace tribo::session {

struct MillCollision {
    milling::CollisionKind kind;
    int line = 0;
    double t_s = 0;
    Vec3 tip_mm;
};

struct MillTotals {
    double duration_s = 0, cutting_s = 0;
    double path_mm = 0;                         // feed moves
    double removed_mm3 = 0, remaining_mm3 = 0;  // by this job; in the end
    double chip_mm3 = 0;  // as measured, before they are reconciled: should equal what feed moves removed
    double fed_mm3 = 0;   // removed by feed moves
    double mean_force_n = 0, peak_force_n = 0;
    double peak_torque_nmm = 0, peak_power_w = 0;
    // Of the spindle, and what of it the shear coefficient ktc explains: ktc times the chips' volume. The
    // rest is the edge coefficient's.
    double work_j = 0, shear_work_j = 0;
    double tooth_passing_hz = 0;  // of the longest cutting time
    std::size_t rows = 0;
    // The work that shears over ktc times the volume that feed moves removed: 1 where the force is true to
    // the metal, whatever the cut. Absent where nothing was cut or the engagement is prescribed.
    std::optional<double> energy_balance;
    std::vector<MillCollision> collisions;  // one per line and kind
    milling::ChipFindings chips;
};

}  // namespace tribo::session
