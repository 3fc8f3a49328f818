// SPDX-License-Identifier: MIT
// Measures by which a friction sound and its imitation are compared. Allocates; any thread.
#pragma once

#include <span>
#include <vector>

#include "noise/ar_model.hpp"

namespace tribo::noise {

// Fourth moment over the squared second: 3 for Gaussian noise, more for grain.
double kurtosis(std::span<const double> sound);

// Standard deviation, in dB, of the level of frames of 10 ms (frames without any sound are left out).
double level_deviation_db(std::span<const double> sound, double sample_rate_hz, double frame_s = 0.01);

// Levels in dB of the frames one after another.
std::vector<double> frame_levels_db(std::span<const double> sound, std::size_t frame);

// Root mean square of the difference in dB between two power densities at 50 Hz steps from 200 Hz to
// `to_hz`, each scaled to the same mean of its logarithm: shape alone.
double log_spectral_distance_db(const ArModel& a, const ArModel& b, double to_hz = 20000);

// Power density (mean over frames of `frame` samples under a Hann window, half overlapping) at `bands` equal
// steps of frequency from 0 to half the rate, as band means; its mean is the mean square.
std::vector<double> power_spectrum(std::span<const double> sound, std::size_t frame = 1024);

}  // namespace tribo::noise
