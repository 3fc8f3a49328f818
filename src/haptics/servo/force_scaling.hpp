// SPDX-License-Identifier: MIT
// Scales forces from hundreds of newtons at the cutter to a few newtons at a desktop arm.
#pragma once

#include "base/vec3.hpp"

namespace tribo::haptics {

enum class ScalingLaw {
    gain,         // gain |F|: keeps ratios; the arm clamps large forces
    compressive,  // gain |F| / (1 + gain |F| / limit): slope `gain` near zero, always below the limit, so
                  // that a heavy cut feels heavier than a medium one
};

struct ForceScaling {
    double gain = 0.01;  // newtons at the hand per newton at the cutter, > 0
    ScalingLaw law = ScalingLaw::gain;
    double limit_n = 3.3;  // of the arm, > 0; used by the compressive law

    // Keeps the direction. Real-time safe.
    Vec3 apply(Vec3 force_n) const {
        const Vec3 scaled = gain * force_n;
        return law == ScalingLaw::gain ? scaled : scaled / (1 + length(scaled) / limit_n);
    }
};

}  // namespace tribo::haptics
