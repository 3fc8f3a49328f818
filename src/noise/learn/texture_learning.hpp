// SPDX-License-Identifier: MIT
// Finds the texture of a recording. Steps:
// - Remove the slow level, which comes from the hand (slow_level.hpp).
// - Take single grains out of the prediction error of the all-pole model.
// - Measure the level of bands of the rest, frame by frame, as a process over the distance of the finger.
// - Subtract the values of Gaussian noise of the same model under the same analysis, so that a Gaussian
//   recording gets no texture.
// - Play the texture and fit it until it has the kurtosis of the recording and its modulation from 4 to
//   64 Hz, in each band and as a whole.
// Allocates; any thread.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "noise/model/ar_model.hpp"
#include "noise/model/texture_model.hpp"

namespace tribo::noise {

// `pieces` of sound at the sample rate of the model, recorded at this speed. Returns none if the sound is
// Gaussian.
std::optional<TextureModel> learn_texture(std::span<const std::span<const double>> pieces,
                                          const ArModel& model, double speed_mm_per_s);

// Takes the grains out of a residual (white, mean square 1): impulses that exceed their surroundings by the
// factor kGrainThreshold. Noise at the level of the surroundings replaces them in `residual`. Times are
// converted to distances by `sample_rate_hz` and speed.
inline constexpr double kGrainThreshold = 5.5;
GrainModel take_grains(std::vector<double>& residual, double sample_rate_hz, double speed_mm_per_s);

}  // namespace tribo::noise
