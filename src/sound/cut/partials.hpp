// SPDX-License-Identifier: MIT
// Sums of sines that are locked to one turning phase.
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
    double peak() const;  // 2 sum |c_n|: never exceeded, whatever the phases
};

// a + t (b - a), partial by partial.
Partials mix(const Partials& a, const Partials& b, double t);

// The partials of a force: what the spindle feels in its plane. Of each harmonic (x, y) the size is that of
// both components together, sqrt(|x|^2 + |y|^2), and the phase that of x - i y, which is the right one for a
// force that swings along any fixed line and for one that turns with the tool (no phase that is continuous
// everywhere exists for a pair; this one fails for a force that turns against the tool). Times `scale`.
// Harmonics beyond kMaxPartials are left out.
Partials in_plane_partials(const contact::ForceSpectrum& spectrum, double scale);

// How much of a partial at this frequency is played: nothing where the sample rate cannot carry it (from
// 0.98 of half the rate on; fading from 0.9) or where it is no sound (up to 10 Hz; fading below 20 Hz).
double audible_share(double frequency_hz, double sample_rate_hz);

// Every partial times audible_share at n times `fundamental_hz`.
Partials audible(const Partials& partials, double fundamental_hz, double sample_rate_hz);

// A quadratic spline through three values told a quantum apart, at the share t of the quantum between the
// middles: b0 + t (b1 + t b2), from half way between `before` and `here` to half way between `here` and
// `after`. It joins with the same slope and never leaves the range of the three.
struct Spline {
    double b0, b1, b2;

    Spline(double before, double here, double after)
        : b0(0.5 * (before + here)), b1(here - before), b2(0.5 * (before - 2 * here + after)) {}
    double at(double t) const { return b0 + t * (b1 + t * b2); }
};

// out[j] = 2 Re sum c_n e^{i n step phase(j)}, j = 0 ... 63, each c_n along the spline through its three
// values. Horner's scheme in e^{i step phase}, four frames abreast, in double: errors far below 24 bits.
// Real-time safe.
void play(const Partials& before, const Partials& here, const Partials& after, const PhasePiece& phase,
          int step, Quantum& out);

}  // namespace tribo::sound
