// SPDX-License-Identifier: MIT
// A steady cut simulated in time: tool and part start at rest, fully engaged.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "dynamics/vibration.hpp"
#include "session/chatter/steady_cut.hpp"

namespace tribo::session {

inline constexpr double kVibrationHz = 48000;

struct Simulation {
    double spindle_rpm = 0, axial_depth_mm = 0;
    int turns = 1;  // of the spindle

    double lasts_s() const { return turns * 60 / spindle_rpm; }
};

// The steps are shorter than the samples where a mode or the teeth are fast (dynamics::enough_rate_hz).
int steps_per_sample(std::span<const dynamics::Mode> modes, const milling::Cutter& cutter,
                     double spindle_rpm);

struct SimulationPeaks {
    double displacement_mm = 0, force_n = 0;  // lengths of vectors, at most
    std::optional<double> ended_s;            // where the tool moved farther than the equations hold
};

// Of the diameter: beyond it the angles of the cut are others, and a real tool breaks.
inline constexpr double kLargestDisplacement = 0.1;

// Calls visit(n, sample) for t = n / kVibrationHz until the turns are over, the displacement exceeds
// kLargestDisplacement times the diameter, or visit returns false. The feed per
// tooth is that of the cut. Deterministic.
SimulationPeaks simulate(const SteadyCut& cut, const Simulation& simulation,
                         const std::function<bool(std::size_t n, const dynamics::VibrationSample&)>& visit);

}  // namespace tribo::session
