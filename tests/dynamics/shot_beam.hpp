// SPDX-License-Identifier: MIT
// The tip of a stepped Timoshenko beam under a harmonic force, by integrating the equations of the beam from
// its tip to the ground: no elements, no eigenvalues.
#pragma once

#include <array>
#include <span>

#include "base/math.hpp"
#include "dynamics/beam.hpp"

namespace tribo::dynamics::test {

// Displacement, turn, moment, shear force.
using BeamState = std::array<double, 4>;

inline BeamState slope(const BeamSection& s, double square, const BeamState& y) {
    const double d2 = s.diameter_mm * s.diameter_mm;
    const double area = math::kPi / 4 * d2, inertia = area * d2 / 16;
    const double shear = 6 * (1 + s.material.poisson) / (7 + 6 * s.material.poisson);
    const double ga = shear * area * s.material.young_n_per_mm2 / (2 * (1 + s.material.poisson));
    const double rho = s.material.density_t_per_mm3;
    return {y[1] + y[3] / ga, y[2] / (s.material.young_n_per_mm2 * inertia),
            -y[3] - rho * inertia * square * y[1], -rho * area * square * y[0]};
}

inline BeamState shot(std::span<const BeamPart> parts, double square, BeamState y) {
    constexpr int kSteps = 400;
    for (const BeamPart& part : parts) {
        for (const BeamSection& s : part.sections) {
            const double h = s.length_mm / kSteps;
            const auto moved = [&](const BeamState& k, double by) {
                BeamState z = y;
                for (std::size_t n = 0; n < 4; ++n) z[n] += by * k[n];
                return z;
            };
            for (int step = 0; step < kSteps; ++step) {  // Runge and Kutta
                const BeamState a = slope(s, square, y), b = slope(s, square, moved(a, h / 2));
                const BeamState c = slope(s, square, moved(b, h / 2)), d = slope(s, square, moved(c, h));
                for (std::size_t n = 0; n < 4; ++n) y[n] += h / 6 * (a[n] + 2 * b[n] + 2 * c[n] + d[n]);
            }
        }
        y[0] += y[3] / part.joint.across_n_per_mm;
        y[1] += y[2] / part.joint.turn_nmm_per_rad;
    }
    return y;
}

// Displacement of the tip over a harmonic force there, without damping, mm/N.
inline double tip_receptance(std::span<const BeamPart> parts, double frequency_hz) {
    const double w = math::kTwoPi * frequency_hz, square = w * w;
    const BeamState moved = shot(parts, square, {1, 0, 0, 0}), turned = shot(parts, square, {0, 1, 0, 0});
    const BeamState pushed = shot(parts, square, {0, 0, 0, -1});
    // On the ground displacement and turn are 0.
    const double det = moved[0] * turned[1] - moved[1] * turned[0];
    return (turned[0] * pushed[1] - pushed[0] * turned[1]) / det;
}

}  // namespace tribo::dynamics::test
