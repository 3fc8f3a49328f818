// SPDX-License-Identifier: MIT
#include "dynamics/vibration.hpp"

#include <algorithm>

#include "base/math.hpp"
#include "milling/engagement/engaged_edges.hpp"

namespace tribo::dynamics {
namespace {

std::vector<double> phases(const milling::Cutter& cutter) {
    std::vector<double> phase_rad;
    double phase = 0;
    for (std::size_t tooth = 0; tooth < static_cast<std::size_t>(cutter.flutes); ++tooth) {
        phase_rad.push_back(phase);
        phase += cutter.pitch_deg.empty() ? math::kTwoPi / cutter.flutes
                                          : cutter.pitch_deg[tooth] * math::kRadPerDeg;
    }
    return phase_rad;
}

}  // namespace

double enough_rate_hz(std::span<const Mode> modes, const milling::Cutter& cutter, double spindle_rpm) {
    constexpr double kPerCycle = 20, kPerTooth = 8;
    double fastest_hz = 0;
    for (const Mode& mode : modes) fastest_hz = std::max(fastest_hz, mode.frequency_hz);
    // With unequal pitch some teeth follow sooner.
    double least_pitch_deg = 360.0 / cutter.flutes;
    for (const double pitch : cutter.pitch_deg) least_pitch_deg = std::min(least_pitch_deg, pitch);
    const double tooth_hz = spindle_rpm / 60 * 360 / least_pitch_deg;
    return std::max(kPerCycle * fastest_hz, kPerTooth * tooth_hz);
}

Vibration::Vibration(std::span<const Mode> modes, const milling::Cutter& cutter,
                     const milling::CuttingCoefficients& coefficients, double rate_hz, double rotation_rad)
    : cutter_(cutter),
      coefficients_(milling::EngagedEdges(cutter, coefficients).coefficients()),
      rate_hz_(rate_hz),
      straight_(cutter.lag_rad(1) == 0 && cutter.corner_radius_mm() == 0),
      slicer_(cutter),
      phase_rad_(phases(cutter)),
      modes_(modes, rate_hz),
      spindle_(rotation_rad),
      past_(cutter, rotation_rad),
      in_cut_(phase_rad_) {
    for (const double phase : phase_rad_) {
        double sine, cosine;
        math::sincos(phase, sine, cosine);
        by_sine_.push_back(D2{cosine, -sine});
        by_cosine_.push_back(D2{sine, cosine});
        math::sincos(cutter.runout_deg * math::kRadPerDeg - phase, sine, cosine);
        runout_mm_.push_back(D2{-cutter.runout_mm * sine, cutter.runout_mm * cosine});
    }
    straight_teeth_.reserve(phase_rad_.size());
}

void Vibration::scale_modes(double factor) {
    modes_.scale(factor);
}

void Vibration::turn_modes(std::span<const Mode> modes) {
    modes_.turn(modes);
}

void Vibration::engage(std::span<const milling::EngagementBand> bands, const milling::ToolTravel& per_tooth,
                       double spindle_rpm, double feed_rad) {
    slices_.clear();
    for (milling::EngagementBand band : bands) {
        // Rotations run clockwise.
        band.entry_rad -= feed_rad;
        band.exit_rad -= feed_rad;
        slicer_.add(band, slices_);
    }
    double sine, cosine;
    math::sincos(feed_rad, sine, cosine);
    const milling::ToolTravel feed = (cutter_.flutes / math::kTwoPi) * per_tooth;
    const D2 across{cosine * feed.across_mm, sine * feed.across_mm};
    const D2 turn{cosine * feed.turn_x_rad - sine * feed.turn_y_rad,
                  sine * feed.turn_x_rad + cosine * feed.turn_y_rad};
    past_.set_feed({{across, -feed.down_mm}, turn}, feed.turns());
    const double step_rad = spindle_rpm * math::kTwoPi / 60 / rate_hz_;
    spindle_.set_step(step_rad);
    past_.set_speed(step_rad);
    in_cut_.engage(slices_, step_rad);
    straight_teeth_.clear();
}

VibrationSample Vibration::step() {
    past_.expect(spindle_.rotation_rad(), modes_.displacement(force_n_));
    cut_ = ~TeethThatCut{0};
    force_n_ = straight_ && !past_.turns() ? straight_force() : helical_force();
    const LaneVec3 displacement_mm = modes_.displacement(force_n_);
    modes_.advance(force_n_);
    past_.add(displacement_mm, cut_);
    spindle_.advance();
    return {displacement_mm.vec3(), force_n_.vec3()};
}

}  // namespace tribo::dynamics
