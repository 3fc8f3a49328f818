// SPDX-License-Identifier: MIT
// Where the teeth of a cutter stand on its circumference.
#pragma once

#include <vector>

#include "base/math.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::milling {

// Angle of each tooth at the tip ahead of flute 0, ascending from 0. The cutter must pass its check(), which
// allows pitches to miss the full turn by rounding: they are stretched to it.
inline std::vector<double> tooth_phases_rad(const Cutter& cutter) {
    const double even = math::kTwoPi / cutter.flutes;
    std::vector<double> phases;
    double phase = 0;
    for (int j = 0; j < cutter.flutes; ++j) {
        phases.push_back(phase);
        phase += cutter.pitch_deg.empty() ? even
                                          : cutter.pitch_deg[static_cast<std::size_t>(j)] * math::kRadPerDeg;
    }
    const double closing = math::kTwoPi / phase;
    for (double& p : phases) p *= closing;
    return phases;
}

}  // namespace tribo::milling
