// SPDX-License-Identifier: MIT
#include "dynamics/stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "base/math.hpp"
#include "dynamics/largest_eigenvalue.hpp"
#include "dynamics/period_step.hpp"

namespace tribo::dynamics {
namespace {

using Complex = std::complex<double>;

// The line that the modes answer most, of those that a multiplier at this angle has.
double chatter_line(std::span<const Mode> modes, double angle_rad, double period_s) {
    double fastest = 0;
    for (const Mode& mode : modes) fastest = std::max(fastest, mode.frequency_hz);
    double best = 0, most = -1;
    const int lines = static_cast<int>(std::ceil(2 * fastest * period_s)) + 1;
    for (int n = 0; n <= lines; ++n) {
        for (const double sign : {-1.0, 1.0}) {
            const double hz = (sign * angle_rad / math::kTwoPi + n) / period_s;
            if (hz < 0) continue;
            double answer = 0;
            for (const Mode& mode : modes) answer = std::max(answer, std::abs(receptance(mode, hz)));
            if (answer > most) {
                most = answer;
                best = hz;
            }
        }
    }
    return best;
}

}  // namespace

Stability stability(std::span<const Mode> modes, const CutFeedback& cut) {
    const PeriodStep step(modes, cut);
    const Complex largest = largest_eigenvalue(
        step.size(), step.states(), [&](const double* from, double* to) { step.advance(from, to); });
    Stability s;
    s.multiplier = std::abs(largest);
    s.angle_rad = std::abs(std::arg(largest));
    s.period_s = cut.period_s();
    s.chatter_hz = chatter_line(modes, s.angle_rad, s.period_s);
    constexpr double kTurned = 1e-6;  // rad
    if (s.multiplier > 1)
        s.kind =
            math::kPi - s.angle_rad < kTurned ? ChatterKind::period_doubling : ChatterKind::quasi_periodic;
    return s;
}

DepthLimit depth_limit(const std::function<Stability(double depth_mm)>& at, double most_mm) {
    constexpr int kSteps = 400, kHalvings = 40;
    const double step = most_mm / kSteps;
    double stable = 0;
    for (int n = 1; n <= kSteps; ++n) {
        const double depth = n * step;
        Stability there = at(depth);
        if (there.multiplier <= 1) {
            stable = depth;
            if (n == kSteps) return {std::nullopt, there};
            continue;
        }
        double unstable = depth;
        for (int half = 0; half < kHalvings; ++half) {
            const double middle = 0.5 * (stable + unstable);
            const Stability seen = at(middle);
            if (seen.multiplier > 1) {
                unstable = middle;
                there = seen;
            } else {
                stable = middle;
            }
        }
        return {unstable, there};
    }
    return {};
}

}  // namespace tribo::dynamics
