// SPDX-License-Identifier: MIT
// Modes of vibration of the tool and of the part, as the cutter's tip feels them.
#pragma once

#include <complex>

#include "base/vec3.hpp"

namespace tribo::dynamics {

enum class ModeOn { tool, part };

// How well a mode is known: in 9 of 10 cases a true value lies between the stated one divided by 1 + spread
// and times 1 + spread. 0: exactly.
struct ModeSpread {
    double frequency = 0, damping = 0, stiffness = 0;

    bool any() const { return frequency > 0 || damping > 0 || stiffness > 0; }
};

// m (q'' + 2 zeta w q' + w^2 q) = F . d, with m = k / w^2 and the unit direction d. The tip of a tool moves
// by q d; a part is driven by -F and moves by -q d, so that both add to the displacement of tool against
// part.
struct Mode {
    Vec3 direction{1, 0, 0};        // any length above 0
    double frequency_hz = 0;        // undamped, > 0
    double damping_ratio = 0;       // 0 < zeta < 1
    double stiffness_n_per_mm = 0;  // > 0
    ModeOn on = ModeOn::tool;
    ModeSpread spread{};
    bool estimated = false;  // from the shape of the tool (tool_estimate.hpp), not measured
};

// Displacement along the mode's direction over a harmonic force e^(iwt) along it, mm/N.
std::complex<double> receptance(const Mode& mode, double frequency_hz);

}  // namespace tribo::dynamics
