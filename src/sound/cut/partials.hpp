// SPDX-License-Identifier: MIT
// Sums of sines at multiples of one phase.
#pragma once

#include <array>

#include "contact/force_spectrum.hpp"
#include "sound/cut/spindle_phase.hpp"
#include "sound/cut/voice.hpp"

namespace tribo::sound {

inline constexpr int kMaxPartials = 64;

// Complex amplitudes c of partials 1 ... count: the sound is 2 Re sum c_n e^{i n phase}.
struct Partials {
    int count = 0;
    std::array<double, kMaxPartials> re{}, im{};  // zero from `count` on

    bool silent() const { return count == 0; }
    double peak() const;  // 2 sum |c_n|: upper bound for all phases
};

// a + t (b - a), partial by partial.
Partials mix(const Partials& a, const Partials& b, double t);

// The partials of the in-plane force, times `scale`. The amplitude of a harmonic (x, y) is
// sqrt(|x|^2 + |y|^2). Its phase is the phase of x - i y. This phase is correct for a force along any fixed
// line and for a force that turns with the tool. It is not continuous for a force that turns against the
// tool; no phase of a pair is continuous everywhere. Harmonics above kMaxPartials are left out.
Partials in_plane_partials(const contact::ForceSpectrum& spectrum, double scale);

// Gain of a partial at this frequency. 0 near the Nyquist frequency (from 0.98 of it on, fading from 0.9) and
// below hearing (up to 10 Hz, fading below 20 Hz).
double audible_share(double frequency_hz, double sample_rate_hz);

// Every partial times audible_share at n times `fundamental_hz`.
Partials audible(const Partials& partials, double fundamental_hz, double sample_rate_hz);

// Quadratic spline of three values, one quantum apart: b0 + t (b1 + t b2), 0 <= t <= 1. It runs from the mean
// of `before` and `here` to the mean of `here` and `after`. The slope is continuous, and the values stay
// within the range of the three.
struct Spline {
    double b0, b1, b2;

    Spline(double before, double here, double after)
        : b0(0.5 * (before + here)), b1(here - before), b2(0.5 * (before - 2 * here + after)) {}
    double at(double t) const { return b0 + t * (b1 + t * b2); }
};

// out[j] = 2 Re sum c_n e^{i n step phase(j)}, j = 0 ... 63. Each c_n follows the spline of its three values.
// Horner's scheme in e^{i step phase}, four frames in parallel, in double: errors far below 24 bits.
// Real-time safe.
void play(const Partials& before, const Partials& here, const Partials& after, const PhasePiece& phase,
          int step, Quantum& out);

}  // namespace tribo::sound
