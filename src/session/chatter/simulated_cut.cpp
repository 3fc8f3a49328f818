// SPDX-License-Identifier: MIT
#include "session/chatter/simulated_cut.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::session {
int steps_per_sample(std::span<const dynamics::Mode> modes, const milling::Cutter& cutter, double rpm) {
    return std::max(1, static_cast<int>(std::ceil(enough_rate_hz(modes, cutter, rpm) / kVibrationHz)));
}

SimulationPeaks simulate(const SteadyCut& cut, const Simulation& simulation,
                         const std::function<bool(std::size_t n, const dynamics::VibrationSample&)>& visit) {
    const SpindleVariation& variation = cut.variation;
    const int steps = steps_per_sample(cut.modes, cut.cutter, (1 + variation.share) * simulation.spindle_rpm);
    dynamics::Vibration vibration(cut.modes, cut.cutter, cut.coefficients, steps * kVibrationHz);
    vibration.engage(cut.bands_at(simulation.axial_depth_mm), {.across_mm = cut.feed_per_tooth_mm},
                     simulation.spindle_rpm);
    SimulationPeaks peaks;
    const auto samples = static_cast<std::size_t>(std::ceil(simulation.lasts_s() * kVibrationHz));
    for (std::size_t n = 0; n < samples; ++n) {
        if (variation.is_there() && n % kVariationSamples == 0)
            vibration.turn_at(
                variation.rpm_at(simulation.spindle_rpm, static_cast<double>(n) / kVibrationHz));
        dynamics::VibrationSample first;
        for (int step = 0; step < steps; ++step) {
            const dynamics::VibrationSample sample = vibration.step();
            if (step == 0) first = sample;
            peaks.displacement_mm = std::max(peaks.displacement_mm, length(sample.displacement_mm));
            peaks.force_n = std::max(peaks.force_n, length(sample.force_n));
        }
        if (peaks.displacement_mm > kLargestDisplacement * cut.cutter.diameter_mm) {
            peaks.ended_s = static_cast<double>(n) / kVibrationHz;
            break;
        }
        if (!visit(n, first)) break;
    }
    return peaks;
}

}  // namespace tribo::session
