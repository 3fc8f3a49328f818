// SPDX-License-Identifier: MIT
#include "session/chatter/simulated_cut.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::session {
namespace {

constexpr double kStepsPerCycle = 20, kStepsPerTooth = 8;

// Steps per sample.
int steps_of(const SteadyCut& cut, double spindle_rpm) {
    double fastest_hz = 0;
    for (const dynamics::Mode& mode : cut.modes) fastest_hz = std::max(fastest_hz, mode.frequency_hz);
    // With unequal pitch some teeth follow sooner.
    double least_pitch_deg = 360.0 / cut.cutter.flutes;
    for (const double pitch : cut.cutter.pitch_deg) least_pitch_deg = std::min(least_pitch_deg, pitch);
    const double tooth_hz = spindle_rpm / 60 * 360 / least_pitch_deg;
    const double steps_hz = std::max(kStepsPerCycle * fastest_hz, kStepsPerTooth * tooth_hz);
    return std::max(1, static_cast<int>(std::ceil(steps_hz / kVibrationHz)));
}

}  // namespace

SimulationPeaks simulate(const SteadyCut& cut, const Simulation& simulation,
                         const std::function<bool(std::size_t n, const dynamics::VibrationSample&)>& visit) {
    const int steps = steps_of(cut, simulation.spindle_rpm);
    dynamics::Vibration vibration(cut.modes, cut.cutter, cut.coefficients, steps * kVibrationHz);
    vibration.engage(cut.bands_at(simulation.axial_depth_mm), {.across_mm = cut.feed_per_tooth_mm},
                     simulation.spindle_rpm);
    SimulationPeaks peaks;
    const auto samples = static_cast<std::size_t>(std::ceil(simulation.lasts_s() * kVibrationHz));
    for (std::size_t n = 0; n < samples; ++n) {
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
