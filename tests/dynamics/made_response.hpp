// SPDX-License-Identifier: MIT
// Frequency responses that are made of known modes, with noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <span>
#include <vector>

#include "dynamics/mode_fit.hpp"

namespace tribo::dynamics {

struct MadeResponse {
    std::vector<double> hz;
    std::vector<std::complex<double>> h;

    void add(const FittedMode& mode) {
        for (std::size_t n = 0; n < hz.size(); ++n) {
            const double r = hz[n] / mode.frequency_hz;
            h[n] +=
                1.0 / (mode.stiffness_n_per_mm * std::complex<double>(1 - r * r, 2 * mode.damping_ratio * r));
        }
    }
    // Complex noise of this standard deviation, as a share of each value of what is measured, and of the
    // largest one.
    void add_noise(double share_of_each, double share_of_largest, unsigned seed, int derivatives = 0) {
        std::mt19937 random(seed);
        std::normal_distribution<double> normal;
        double largest = 0;
        for (std::size_t n = 0; n < hz.size(); ++n)
            largest = std::max(largest, std::pow(hz[n], derivatives) * std::abs(h[n]));
        for (std::size_t n = 0; n < hz.size(); ++n) {
            const double even = share_of_largest * largest / std::pow(hz[n], derivatives);
            const double deviation = std::hypot(share_of_each * std::abs(h[n]), even) / std::sqrt(2.0);
            const double re = normal(random), im = normal(random);
            h[n] += deviation * std::complex<double>(re, im);
        }
    }
};

inline MadeResponse made_of(std::span<const FittedMode> modes, double from_hz, double to_hz, double step_hz) {
    MadeResponse made;
    for (int n = 0; from_hz + n * step_hz <= to_hz; ++n) made.hz.push_back(from_hz + n * step_hz);
    made.h.resize(made.hz.size());
    for (const FittedMode& mode : modes) made.add(mode);
    return made;
}

}  // namespace tribo::dynamics
