// SPDX-License-Identifier: MIT
// Measures for the comparison of a friction sound with its imitation. Allocates; any thread.
#pragma once

#include <span>
#include <vector>

#include "noise/model/ar_model.hpp"

namespace tribo::noise {

// Fourth moment over the squared second: 3 for Gaussian noise, larger for grainy sound.
double kurtosis(std::span<const double> sound);

// Standard deviation, in dB, of the level of frames of 10 ms. Frames without any sound are skipped.
double level_deviation_db(std::span<const double> sound, double sample_rate_hz, double frame_s = 0.01);

// Levels in dB of consecutive frames.
std::vector<double> frame_levels_db(std::span<const double> sound, std::size_t frame);

// Fluctuation of the envelope (RMS of frames of 2 ms) relative to its mean: power density in half octaves
// around `hz`, each 2 ... 200. A second of sound resolves these bands; shorter sound blurs them.
std::vector<double> modulation_density(std::span<const double> sound, double sample_rate_hz,
                                       std::span<const double> hz);

// Power density in `bands` equal steps of frequency from 0 to half the rate, as band means. It is the mean
// over half-overlapping frames of `frame` samples (a power of two) under a Hann window. Shorter sound is one
// frame under a window of its own length, padded with zeros. Its mean is the mean square.
std::vector<double> power_spectrum(std::span<const double> sound, std::size_t frame = 1024);

// Spectra need pieces of `wanted` samples, as shorter ones are mostly window. Returns the length from which
// on pieces are of use: `wanted`, or half of the longest piece where that is less.
std::size_t shortest_of_use(std::span<const std::span<const double>> pieces, std::size_t wanted);

// The same with frames of 1024 samples, in dB, of one sound or of pieces (of those of use); no frame spans
// two pieces. spectrum_hz() gives the frequencies of the bands, the last function the spectrum of a model at
// them.
std::vector<double> spectrum_db(std::span<const double> sound);
std::vector<double> spectrum_db(std::span<const std::span<const double>> pieces);
std::vector<double> spectrum_hz(double sample_rate_hz);
std::vector<double> spectrum_db(const ArModel& model, std::span<const double> hz, double level_db = 0);
// RMS difference of two spectra in dB from 200 Hz to 20 kHz, without their mean difference: only the shape
// counts.
double shape_distance_db(std::span<const double> a, std::span<const double> b, std::span<const double> hz);

}  // namespace tribo::noise
