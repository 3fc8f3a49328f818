// SPDX-License-Identifier: MIT
// Modal resonances of tool, part and machine: the filter from a force to its sound. The tool vibrates like a
// clamped bar; the material of the part adds damping.
#pragma once

#include <array>
#include <string_view>

#include "sound/cut/voice.hpp"

namespace tribo::sound {

struct BodyMode {
    double hz = 0;          // 0: none
    double damping = 0.02;  // ratio to critical damping
    double gain = 1;        // at its frequency; negative: opposite to the force
};
// A direct path and parallel modes.
struct Body {
    static constexpr std::size_t kModes = 8;
    double direct = 1;
    std::array<BodyMode, kModes> modes{};

    bool rings() const { return modes[0].hz > 0; }  // used modes come first
};

// Appends the modes of `more` to those of `body`, with their gains times `gain`, as far as there is room.
Body with_modes(const Body& body, const Body& more, double gain);

// Decay time by 60 dB of the slowest mode, kLongestRingSeconds at most.
inline constexpr double kLongestRingSeconds = 0.5;
double ring_seconds(const Body& body);

// The first two bending modes of a carbide cutter with overhang length_mm: a bar clamped at one end, 3.516
// and 22.03 / (2 pi L^2) sqrt(E I / (rho A)). The flutes leave a core of 0.8 D (E 580 GPa, 14,500 kg/m^3).
// `material_damping` is added to the damping of the tool.
Body tool_body(double diameter_mm, double length_mm, double material_damping);

// Additional damping ratio by the material of the workpiece (a name of the materials library): soft metals
// damp a tool more than hard ones. Orders of magnitude, not measurements.
double material_damping(std::string_view material);

// y = direct x + sum of gain times band-pass of each mode. A band-pass is of second order, with gain 1 at its
// centre. Modes above 0.45 of the sample rate are left out. Real-time safe, about 7 ns per sample.
class BodyFilter {
  public:
    void set(const Body& body, double sample_rate_hz);
    void apply(Quantum& x);
    void forget();
    // Decay time after the end of the input, in quanta.
    int ring_quanta() const { return ring_quanta_; }
    // Gain for a sine.
    double gain_at(double hz) const;
    // RMS gain for pink noise.
    double gain_of_pink() const;

  private:
    // b (1 - z^-2) / (1 + a1 z^-1 + a2 z^-2), a lane for each mode; lanes without a mode have b = 0.
    using Lanes = std::array<double, Body::kModes>;
    double direct_ = 1, sample_rate_hz_ = 48000;
    int modes_ = 0, ring_quanta_ = 1;
    Lanes gain_{}, b_{}, a1_{}, a2_{}, s1_{}, s2_{};
};

}  // namespace tribo::sound
