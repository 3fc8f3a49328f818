// SPDX-License-Identifier: MIT
// Fits auto-regressive models to samples: Yule-Walker equations by Levinson and Durbin, and Burg's method.
// Both give reflection coefficients inside (-1, 1). Allocates; any thread.
// Sources: Durbin 1960; Burg 1975; Markel and Gray 1976.
#pragma once

#include <span>
#include <vector>

namespace tribo::noise {

// Reflection coefficients k_1 ... k_p from an autocorrelation r_0 > 0, r_1 ... r_p. `white`: share of r_0
// that is added to r_0, so that spectra with empty bands stay well conditioned.
std::vector<double> levinson(std::span<const double> autocorrelation, double white = 0);

// The same by least squares of forward and backward prediction errors over all stretches. It uses no window
// and is sharper with little data. Stretches shorter than the order are skipped.
std::vector<double> burg(std::span<const std::span<const double>> stretches, int order);

}  // namespace tribo::noise
