// SPDX-License-Identifier: MIT
// The pressure around a contact as its equations say it (elastic/pressure.hpp), in double precision.
#pragma once

#include <cmath>

#include "elastic/pressure.hpp"

namespace tribo::elastic::test {

inline double pressure_share(ContactShape shape, double rho) {
    if (!(rho < kReach)) return 0;
    const double centre = std::exp(-5.0), decay = (1 - kEdgeDrop) * (1 - centre) / (5 * kEdgeDrop);
    const double inward = 1 - rho * rho / (kReach * kReach), window = inward * inward;
    if (shape == ContactShape::point) return window * std::exp(-rho / decay);
    if (rho <= 1) return window * (1 - kEdgeDrop * (std::exp(5 * (rho - 1)) - centre) / (1 - centre));
    return window * (1 - kEdgeDrop) * std::exp(-(rho - 1) / decay);
}

}  // namespace tribo::elastic::test
