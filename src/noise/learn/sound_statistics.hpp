// SPDX-License-Identifier: MIT
// Measures by which a friction sound and its imitation are compared. Allocates; any thread.
#pragma once

#include <span>
#include <vector>

#include "noise/model/ar_model.hpp"

namespace tribo::noise {

// Fourth moment over the squared second: 3 for Gaussian noise, more for grain.
double kurtosis(std::span<const double> sound);

// Standard deviation, in dB, of the level of frames of 10 ms (frames without any sound are left out).
double level_deviation_db(std::span<const double> sound, double sample_rate_hz, double frame_s = 0.01);

// Levels in dB of the frames one after another.
std::vector<double> frame_levels_db(std::span<const double> sound, std::size_t frame);

// Fluctuation of the envelope (RMS of frames of 2 ms) over its mean: power density in half octaves around
// `hz`, each 2 ... 200. Bands a second of sound resolves; less sound blurs them.
std::vector<double> modulation_density(std::span<const double> sound, double sample_rate_hz,
                                       std::span<const double> hz);

// Root mean square of the difference in dB between two power densities at 50 Hz steps from 200 Hz to
// `to_hz`, each scaled to the same mean of its logarithm: shape alone.
double log_spectral_distance_db(const ArModel& a, const ArModel& b, double to_hz = 20000);

// Power density (mean over frames of `frame` samples under a Hann window, half overlapping) at `bands` equal
// steps of frequency from 0 to half the rate, as band means; its mean is the mean square.
std::vector<double> power_spectrum(std::span<const double> sound, std::size_t frame = 1024);

// The same of 1024 samples in dB, of one sound or of pieces, no frame across two of them; where its bands
// are, and a model's there.
std::vector<double> spectrum_db(std::span<const double> sound);
std::vector<double> spectrum_db(std::span<const std::span<const double>> pieces);
std::vector<double> spectrum_hz(double sample_rate_hz);
std::vector<double> spectrum_db(const ArModel& model, std::span<const double> hz, double level_db = 0);
// Root mean square of the difference of two spectra in dB from 200 Hz to 20 kHz, their mean difference taken
// off: shape alone.
double shape_distance_db(std::span<const double> a, std::span<const double> b, std::span<const double> hz);

}  // namespace tribo::noise
