// SPDX-License-Identifier: MIT
#include "dynamics/mode.hpp"

namespace tribo::dynamics {

std::complex<double> receptance(const Mode& mode, double frequency_hz) {
    const double ratio = frequency_hz / mode.frequency_hz;
    const double re = 1 - ratio * ratio, im = 2 * mode.damping_ratio * ratio;
    // Not 1 / (re + i im): a division of complex numbers differs between systems.
    return std::complex<double>(re, -im) / (mode.stiffness_n_per_mm * (re * re + im * im));
}

}  // namespace tribo::dynamics
