// SPDX-License-Identifier: MIT
#include "dynamics/mode.hpp"

namespace tribo::dynamics {

std::complex<double> receptance(const Mode& mode, double frequency_hz) {
    const double ratio = frequency_hz / mode.frequency_hz;
    return 1.0 / (mode.stiffness_n_per_mm *
                  std::complex<double>(1 - ratio * ratio, 2 * mode.damping_ratio * ratio));
}

}  // namespace tribo::dynamics
