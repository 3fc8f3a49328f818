// SPDX-License-Identifier: MIT
// What is known about an uncertain input. Any thread; no allocation.
#pragma once

#include <cstdint>

namespace tribo::sweep {

enum class DistributionKind : std::uint8_t { uniform, normal, lognormal };

// uniform: between a and b, a < b.
// normal: mean a, standard deviation b > 0.
// lognormal: median a > 0; 9 of 10 values lie between a / (1 + b) and a (1 + b), b > 0.
struct Distribution {
    DistributionKind kind = DistributionKind::uniform;
    double a = 0, b = 1;

    bool operator==(const Distribution&) const = default;
};

// Returns the value that a share `below` of all values does not exceed; 0 < below < 1.
double quantile(const Distribution& distribution, double below);

// The same for mean 0 and standard deviation 1, to 1e-15 of itself (Wichura 1988, algorithm AS 241, PPND16).
double normal_quantile(double below);

}  // namespace tribo::sweep
