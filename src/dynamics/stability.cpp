// SPDX-License-Identifier: MIT
#include "dynamics/stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/math.hpp"
#include "dynamics/eigenvalue/chatter_line.hpp"
#include "dynamics/eigenvalue/largest_eigenvalue.hpp"
#include "dynamics/eigenvalue/period_step.hpp"

namespace tribo::dynamics {
namespace {

// Not std::abs: it differs between systems.
double size(std::complex<double> v) {
    return std::sqrt(v.real() * v.real() + v.imag() * v.imag());
}

}  // namespace

Stability stability(std::span<const Mode> modes, const CutFeedback& cut) {
    const PeriodStep step(modes, cut);
    const Eigenpair largest = largest_eigenvalue(
        step.size(), step.states(), [&](const double* from, double* to) { step.advance(from, to); });
    double fastest_hz = 0;
    for (const Mode& mode : modes) fastest_hz = std::max(fastest_hz, mode.frequency_hz);
    Stability s;
    s.multiplier = size(largest.value);
    s.angle_rad = std::abs(math::atan2(largest.value.imag(), largest.value.real()));
    s.period_s = cut.period_s();
    s.chatter_hz = chatter_line_hz(step, largest, s.period_s, fastest_hz);
    constexpr double kTurned = 1e-6;  // rad
    if (s.multiplier > 1)
        s.kind =
            math::kPi - s.angle_rad < kTurned ? ChatterKind::period_doubling : ChatterKind::quasi_periodic;
    return s;
}

DepthLimit depth_limit(const std::function<Stability(double depth_mm)>& at, double most_mm) {
    constexpr int kSteps = 400;
    const double step = most_mm / kSteps;
    Stability there;
    for (int n = 1; n <= kSteps; ++n) {
        there = at(n * step);
        if (there.multiplier > 1) return limit_between(at, (n - 1) * step, n * step, there);
    }
    return {std::nullopt, there};
}

DepthLimit limit_between(const std::function<Stability(double depth_mm)>& at, double stable_mm,
                         double unstable_mm, Stability there) {
    // The secant between both ends, where the value of an end that stays is halved (Illinois), towards a
    // multiplier just above 1.
    constexpr double kBeyond = 1e-8;
    constexpr int kMostCalls = 60;
    const auto above = [](const Stability& s) { return s.multiplier - 1 - kBeyond; };
    double high = above(there), low = 0;  // low: 0 as long as nothing is known there
    int side = 0;
    for (int n = 0; n < kMostCalls && high > kBeyond; ++n) {
        const double share = low < 0 ? low / (low - high) : 0.5;
        const double depth = stable_mm + share * (unstable_mm - stable_mm);
        const Stability seen = at(depth);
        const double found = above(seen);
        if (seen.multiplier > 1) {
            unstable_mm = depth;
            there = seen;
            high = found;
            if (side > 0) low *= 0.5;
            side = 1;
        } else {
            stable_mm = depth;
            low = found;
            if (side < 0) high *= 0.5;
            side = -1;
        }
    }
    return {unstable_mm, there};
}

double phase_rad(std::span<const Mode> modes, const CutFeedback& cut) {
    const Oscillators oscillators(modes);
    double phase = 0;
    for (std::size_t n = 0; n + 1 < cut.events_s().size(); ++n) {
        const double from = cut.events_s()[n], to = cut.events_s()[n + 1];
        phase += oscillators.fastest(cut.spring(0.5 * (from + to))) * (to - from);
    }
    return phase;
}

}  // namespace tribo::dynamics
