// SPDX-License-Identifier: MIT
// Will it chatter: the multipliers of a small vibration over a period of the cut.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "dynamics/cut_feedback.hpp"
#include "dynamics/mode.hpp"

namespace tribo::dynamics {

enum class ChatterKind { stable, quasi_periodic, period_doubling };

struct Stability {
    double multiplier = 0;  // spectral radius over the period: a vibration grows by it; > 1: chatter
    double angle_rad = 0;   // of that multiplier, 0 ... pi
    double chatter_hz = 0;  // of the lines (+-angle / 2 pi + n) / period the one with most of the motion
    double period_s = 0;
    ChatterKind kind = ChatterKind::stable;
};

// The largest eigenvalue of the step from a period to the next (period_step.hpp; Bayly et al. 2003 and
// Butcher et al. 2009 do it with other bases). Good to about 1e-8 with equal pitches, 1e-5 with unequal ones.
// Takes about 20 us with one mode, longer the more often the modes vibrate in a period. At least one mode;
// directions in the frame of `cut`. Any thread; allocates.
Stability stability(std::span<const Mode> modes, const CutFeedback& cut);

// The border of the stable depths at one speed.
struct DepthLimit {
    // The least depth with a multiplier of 1; absent: stable down to the greatest depth asked for.
    std::optional<double> depth_mm;
    Stability there;  // just beyond the border, or at the greatest depth
};

// Walks from depth 0 in steps of a 400th of `most_mm` and narrows the first step in which the cut becomes
// unstable. A narrower island of chatter may be missed.
DepthLimit depth_limit(const std::function<Stability(double depth_mm)>& at, double most_mm);

// Narrows the depths between a stable and an unstable one, until the multiplier is 1 to 1e-8. `there`: of the
// unstable one.
DepthLimit limit_between(const std::function<Stability(double depth_mm)>& at, double stable_mm,
                         double unstable_mm, Stability there);

// The phase in rad by which the fastest mode, stiffened by the cut, turns in a period. Time grows with its
// square.
double phase_rad(std::span<const Mode> modes, const CutFeedback& cut);
inline constexpr double kMostPhaseRad = 1e4;  // beyond a point takes more than a tenth of a second

}  // namespace tribo::dynamics
