// SPDX-License-Identifier: MIT
#include "dynamics/vibration.hpp"

#include <algorithm>

#include "base/math.hpp"
#include "milling/engagement/engaged_edges.hpp"
#include "milling/tool/tooth_phases.hpp"

namespace tribo::dynamics {

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
      phase_rad_(milling::tooth_phases_rad(cutter)),
      modes_(modes, rate_hz),
      spindle_(rotation_rad),
      past_(cutter, rotation_rad),
      in_cut_(phase_rad_) {
    for (const double phase : phase_rad_) {
        double sine, cosine;
        math::sincos(phase, sine, cosine);
        ahead_.emplace_back(sine, cosine);
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
    turn_at(spindle_rpm);
}

void Vibration::turn_at(double spindle_rpm) {
    const double step_rad = spindle_rpm * math::kTwoPi / 60 / rate_hz_;
    spindle_.set_step(step_rad);
    past_.set_speed(step_rad);
    in_cut_.engage(slices_.size(), step_rad, straight_);
    straight_teeth_.clear();
}

void Vibration::gather_straight_teeth() {
    const milling::CuttingCoefficients& k = coefficients_;
    straight_teeth_.clear();
    double height = 0, height_now = 0;
    const std::span<const EdgeInCut> list = in_cut_.list();
    for (std::size_t n = 0; n < list.size(); ++n) {
        const std::size_t tooth = list[n].tooth;
        height += list[n].share * slices_[list[n].slice].whole.height_mm;
        if (list[n].now) height_now += slices_[list[n].slice].whole.height_mm;
        if (n + 1 < list.size() && list[n + 1].tooth == tooth) continue;
        const std::size_t other = tooth + 1 == phase_rad_.size() ? 0 : tooth + 1;
        StraightTooth t;
        t.tooth = tooth;
        t.before = tooth_bit(other);
        t.outward_mm = runout_mm_[tooth][1] - runout_mm_[other][1];
        t.normal = ahead_[tooth];
        // Against the way of the edge (cos, -sin), and inward.
        double sine, cosine;
        math::sincos(phase_rad_[tooth], sine, cosine);
        const auto across = [&](double tangential, double radial) {
            return Turner(-height * (radial * sine + tangential * cosine),
                          height * (tangential * sine - radial * cosine));
        };
        t.per_mm = across(k.ktc, k.krc);
        t.edge_n = across(k.kte, k.kre);
        t.axial_per_mm = height * k.kac;
        t.axial_n = height * k.kae;
        if (height > 0) t.now = height_now / height;
        straight_teeth_.push_back(t);
        height = height_now = 0;
    }
}

// The bands of a straight edge, all at one angle.
inline LaneVec3 Vibration::straight_force(D2 place_mm) {
    if (in_cut_.update(slices_, past_.samples(), spindle_.turn_rad())) gather_straight_teeth();
    const D2 turn = spindle_.sine_cosine();
    LaneVec3 force_n;
    for (const StraightTooth& t : straight_teeth_) {
        const ToolPast::Passage& last = past_.passage(t.tooth, 0);
        const D2 normal = t.normal(turn);
        const D2 along = (place_mm - last.place.tip_mm.xy) * normal;
        double thickness = along[0] + along[1] + t.outward_mm;
        if ((last.cut & t.before) == 0 || !(thickness > 0)) [[unlikely]] {
            thickness = straight_chip(t.tooth, normal);
            if (!(thickness > 0)) continue;
        }
        const D2 across = both(thickness) * t.per_mm(turn) + t.edge_n(turn);
        const double axial = t.axial_per_mm * thickness + t.axial_n;
        force_n.xy += across;
        force_n.z -= axial;
        if (t.now != 1) [[unlikely]] {
            off_mean_n_.xy += both(t.now - 1) * across;
            off_mean_n_.z -= (t.now - 1) * axial;
        }
    }
    return force_n;
}

VibrationSample Vibration::step() {
    past_.expect(spindle_.rotation_rad());
    const LaneVec3 foreseen_mm = modes_.foreseen();
    const ToolPlace& fed = past_.fed();
    place_ = {{fed.tip_mm.xy + foreseen_mm.xy, fed.tip_mm.z + foreseen_mm.z}, fed.turn_rad};
    cut_ = ~TeethThatCut{0};
    off_mean_n_ = {};
    const LaneVec3 force_n = straight_ && !past_.turns() ? straight_force(place_.tip_mm.xy) : helical_force();
    const LaneVec3 displacement_mm = modes_.step(force_n);
    past_.add(displacement_mm, cut_);
    spindle_.advance();
    return {displacement_mm.vec3(), force_n.vec3() + off_mean_n_.vec3()};
}

}  // namespace tribo::dynamics
