// SPDX-License-Identifier: MIT
// A texture by its own sound: what is heard of it, and turning it until that is what a recording has.
// Allocates; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "noise/model/ar_model.hpp"
#include "noise/model/texture_model.hpp"

namespace tribo::noise {

// Half octaves whose modulation a texture takes from its recording: 4 ... 64 Hz.
inline constexpr std::array<double, 8> kModulationHz{4.76, 6.73, 9.51, 13.5, 19.0, 26.9, 38.1, 53.8};

struct HeardTexture {
    // Of each band, and of all together at the end: modulation density at kModulationHz.
    std::vector<std::vector<double>> modulation;
    double kurtosis = 0;
};
HeardTexture heard_texture(const std::vector<double>& sound, double sample_rate_hz,
                           std::span<const double> crossovers_hz);

// One band of a sound, parted by the second-order Butterworth filters with which a texture is played.
std::vector<double> band_of(const std::vector<double>& sound, std::size_t band,
                            std::span<const double> crossovers_hz, double sample_rate_hz);

// The texture with the spread of its levels, the weights of its lengths, its coherence and the share of its
// grains such that what `model` plays of it, `samples` at a time, comes nearest to what is wanted. Tries a
// few rounds on the sound of a few seeds, always the same ones.
TextureModel fitted_texture(const TextureModel& texture, const ArModel& model, double speed_mm_per_s,
                            const HeardTexture& wanted);

}  // namespace tribo::noise
