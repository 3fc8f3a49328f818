// SPDX-License-Identifier: MIT
// Vibration of a slot computed another way: the surface is kept for each angle, steps are a fixed part of a
// tooth, and the modes go by the symplectic Euler method. Straight teeth at equal pitch, no run-out.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.hpp"
#include "dynamics/mode.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::dynamics::test {

// Returns the largest displacement within each tooth period, mm. Cuts with ktc and krc alone, in the plane.
inline std::vector<double> swings_by_angle(const std::vector<Mode>& modes, const milling::Cutter& cutter,
                                           const milling::CuttingCoefficients& k, double depth_mm,
                                           double feed_per_tooth_mm, double spindle_rpm, int teeth,
                                           int steps_per_tooth) {
    struct State {
        Mode mode;
        double mass, damping, q = 0, v = 0;
    };
    std::vector<State> states;
    for (const Mode& mode : modes) {
        const double w = math::kTwoPi * mode.frequency_hz, mass = mode.stiffness_n_per_mm / (w * w);
        states.push_back({mode, mass, 2 * mode.damping_ratio * w * mass});
    }
    const double dt = 60 / (spindle_rpm * cutter.flutes * steps_per_tooth);
    const int per_turn = steps_per_tooth * cutter.flutes;
    // Beyond the first half turn nothing is cut.
    std::vector<double> surface(static_cast<std::size_t>(per_turn), 0);
    std::vector<double> sines, cosines;
    for (int n = 0; n < per_turn; ++n) {
        sines.push_back(std::sin(math::kTwoPi * n / per_turn));
        cosines.push_back(std::cos(math::kTwoPi * n / per_turn));
    }
    std::vector<double> swings;
    for (int tooth = 0; tooth < teeth; ++tooth) {
        double largest = 0;
        for (int step = 0; step < steps_per_tooth; ++step) {
            Vec3 at{}, force{};
            for (const State& s : states) at += s.q * s.mode.direction;
            for (int flute = 0; flute < cutter.flutes; ++flute) {
                const auto n = static_cast<std::size_t>(step + flute * steps_per_tooth);
                if (2 * n > surface.size()) continue;
                // The next tooth comes a feed farther.
                surface[n] -= feed_per_tooth_mm * sines[n];
                const double place = at.x * sines[n] + at.y * cosines[n], chip = place - surface[n];
                if (!(chip > 0)) continue;
                surface[n] = place;
                const double t = k.ktc * depth_mm * chip, r = k.krc * depth_mm * chip;
                force += Vec3{-t * cosines[n] - r * sines[n], t * sines[n] - r * cosines[n], 0};
            }
            for (State& s : states) {
                const double pull =
                    dot(force, s.mode.direction) - s.damping * s.v - s.mode.stiffness_n_per_mm * s.q;
                s.v += dt * pull / s.mass;
                s.q += dt * s.v;
            }
            largest = std::max(largest, length(at));
        }
        swings.push_back(largest);
    }
    return swings;
}

}  // namespace tribo::dynamics::test
