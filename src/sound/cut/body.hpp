// SPDX-License-Identifier: MIT
// What tool, part and machine make of a force before it is heard: they ring in their modes. The tool rings
// like a bar that is held at one end, and the material damps it.
#pragma once

#include <array>
#include <string_view>

#include "sound/cut/voice.hpp"

namespace tribo::sound {

struct BodyMode {
    double hz = 0;          // 0: none
    double damping = 0.02;  // share of the critical
    double gain = 1;        // at its middle; below 0 it moves against the force
};
// What becomes of a force: a share of it as it is, and what each mode makes of it.
struct Body {
    static constexpr std::size_t kModes = 8;
    double direct = 1;
    std::array<BodyMode, kModes> modes{};

    bool rings() const { return modes[0].hz > 0; }  // modes stand at the front
};

// `body` with the modes of `more` behind its own, their gains times `gain`, as far as there is room.
Body with_modes(const Body& body, const Body& more, double gain);

// Seconds in which the slowest mode falls by 60 dB, kLongestRingSeconds at most.
inline constexpr double kLongestRingSeconds = 0.5;
double ring_seconds(const Body& body);

// The first two bending frequencies of a carbide cutter that stands out by length_mm: a bar clamped at one
// end, 3.516 and 22.03 / (2 pi L^2) sqrt(E I / (rho A)), with flutes a core of 0.8 D (E 580 GPa, 14,500
// kg/m^3). `material_damping` adds to the tool's own.
Body tool_body(double diameter_mm, double length_mm, double material_damping);

// Damping that a workpiece of this material (a name of the materials' library) adds, share of the critical:
// soft metals take more of a tool's vibration than hard ones. Orders of magnitude, not measurements.
double material_damping(std::string_view material);

// y = direct x + the sum of each mode's gain times its band, a band-pass of second order that is 1 at the
// middle. Modes beyond 0.45 of the sample rate are left out. Real-time safe, about 7 ns a sample.
class BodyFilter {
  public:
    void set(const Body& body, double sample_rate_hz);
    void apply(Quantum& x);
    void forget();
    // Quanta for which it rings on once its input has ended.
    int ring_quanta() const { return ring_quanta_; }
    // |y| of a sine of amplitude 1.
    double gain_at(double hz) const;
    // RMS of y where x is pink noise of RMS 1.
    double gain_of_pink() const;

  private:
    // b (1 - z^-2) / (1 + a1 z^-1 + a2 z^-2), a lane for each mode; lanes without a mode have b = 0.
    using Lanes = std::array<double, Body::kModes>;
    double direct_ = 1, sample_rate_hz_ = 48000;
    int modes_ = 0, ring_quanta_ = 1;
    Lanes gain_{}, b_{}, a1_{}, a2_{}, s1_{}, s2_{};
};

}  // namespace tribo::sound
