// SPDX-License-Identifier: MIT
// Modes from a measured frequency response at a driving point: displacement over force at the same place, in
// the same direction.
#pragma once

#include <complex>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/result.hpp"

namespace tribo::dynamics {

struct FittedMode {
    double frequency_hz = 0;        // undamped, inside the band
    double damping_ratio = 0;       // within kLimits.mode_damping
    double stiffness_n_per_mm = 0;  // within kLimits.mode_stiffness
};

struct ModeFitOptions {
    double from_hz = 0, to_hz = std::numeric_limits<double>::infinity();
    std::optional<int> modes{};  // how many, within kLimits.fitted_modes; absent: those that stand out
    // Of the displacement, that were measured: 2 of an accelerometer. The noise of what was measured is taken
    // as even over frequency, or growing with the response.
    int derivatives = 0;
};

struct ModeFit {
    std::vector<FittedMode> modes;  // by frequency; never empty
    double from_hz = 0, to_hz = 0;  // the first and the last frequency in the band
    std::size_t points = 0;         // in the band
    double residual = 0;            // root of the sum of squares of the errors over that of the response
    bool other_time_sign = false;   // e^(-iwt): the conjugate was fitted
    bool other_force_sign = false;  // hammer and sensor point against each other: the negative was fitted
};

// Without `modes` at most that many are looked for.
inline constexpr int kMostModesFound = 8;
// More points in the band are averaged in groups of neighbours.
inline constexpr std::size_t kMostFitPoints = 4096;

// Fits 1 / (k (1 - r^2 + 2 i zeta r)), r = frequency over that of the mode, for each mode, and two real
// residual terms (Ewins, Modal Testing, 2nd ed. 2000, ch. 4), by least squares. A mode is added where it
// explains most of what is left (matching pursuit; Mallat and Zhang 1993), then all of them are refined
// together (Levenberg 1944, Marquardt 1963), with the weights of the most likely noise. A mode stays if an
// F-test in its surroundings says that it is no noise, and if its peak has a hundredth of the largest
// response. `frequency_hz` rises, >= 0; both have the same length; all finite. Refuses what has no such mode,
// with a cause and a remedy. Any thread; allocates; some tens of milliseconds with a few modes and 2500
// points.
Result<ModeFit> fit_modes(std::span<const double> frequency_hz,
                          std::span<const std::complex<double>> receptance_mm_per_n,
                          const ModeFitOptions& options = {});

}  // namespace tribo::dynamics
