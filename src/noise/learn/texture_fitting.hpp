// SPDX-License-Identifier: MIT
// Measures the texture of a sound, and fits a texture until it has the measures of a recording. Allocates;
// any thread.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "noise/model/ar_model.hpp"
#include "noise/model/texture_model.hpp"

namespace tribo::noise {

// Half octaves of the modulation that a texture takes from its recording: 4 ... 64 Hz.
inline constexpr std::array<double, 8> kModulationHz{4.76, 6.73, 9.51, 13.5, 19.0, 26.9, 38.1, 53.8};

struct HeardTexture {
    // Modulation density at kModulationHz: of each band, then of all bands together.
    std::vector<std::vector<double>> modulation;
    double kurtosis = 0;
};
HeardTexture heard_texture(const std::vector<double>& sound, double sample_rate_hz,
                           std::span<const double> crossovers_hz);

// Returns one band of a sound, split off by the second-order Butterworth filters of the playback.
std::vector<double> band_of(const std::vector<double>& sound, std::size_t band,
                            std::span<const double> crossovers_hz, double sample_rate_hz);

// Fits the spread of the levels, the weights of the lengths, the coherence and the share of the grains, so
// that the sound played with `model`, `samples` at a time, is closest to the wanted measures. Runs a few
// rounds on the sound of a few seeds, always the same ones.
TextureModel fitted_texture(const TextureModel& texture, const ArModel& model, double speed_mm_per_s,
                            const HeardTexture& wanted);

}  // namespace tribo::noise
