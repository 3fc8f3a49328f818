// SPDX-License-Identifier: MIT
// What tool and material add to the sound of a force: the tool rings like a bar that is held at one end, and
// the material damps it.
#pragma once

#include <array>
#include <string_view>

#include "sound/voice.hpp"

namespace tribo::sound {

struct BodyMode {
    double hz = 0;          // 0: none
    double damping = 0.02;  // share of the critical
};
struct Body {
    std::array<BodyMode, 2> modes{};
};

// The first two bending frequencies of a carbide cutter that stands out by length_mm: a bar clamped at one
// end, 3.516 and 22.03 / (2 pi L^2) sqrt(E I / (rho A)), with flutes a core of 0.8 D (E 580 GPa, 14,500
// kg/m^3). `material_damping` adds to the tool's own.
Body tool_body(double diameter_mm, double length_mm, double material_damping);

// Damping that a workpiece of this material (a name of the materials' library) adds, share of the critical:
// soft metals take more of a tool's vibration than hard ones. Orders of magnitude, not measurements.
double material_damping(std::string_view material);

// y = x + gain * (band of the first mode + band of the second), each band 1 at its middle: the sound keeps
// its level below and gains 6 dB at a mode. Modes beyond 0.45 of the sample rate are left out. Real-time
// safe.
class BodyFilter {
  public:
    void set(const Body& body, double sample_rate_hz);
    void apply(Quantum& x);
    bool rings() const { return rings_; }
    void forget();

  private:
    static constexpr double kGain = 1;
    struct Band {
        double b = 0, a1 = 0, a2 = 0;  // b (1 - z^-2) / (1 + a1 z^-1 + a2 z^-2)
        double s1 = 0, s2 = 0;
    };
    std::array<Band, 2> bands_{};
    bool rings_ = false;
};

}  // namespace tribo::sound
