// SPDX-License-Identifier: MIT
// Finding the texture of a recording. Its slow level goes first: that is the hand's (slow_level.hpp). Then
// single grains are taken out of what the all-pole model does not predict, and the level of bands of what is
// left is measured, frame by frame, as a process over the way of the finger. What Gaussian noise of the same
// model shows under the same analysis is taken off, so that a Gaussian recording gets no texture. At last the
// texture is played and turned until its own sound has the recording's modulation from 4 to 64 Hz in each
// band and as a whole, and its kurtosis. Allocates; any thread.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "noise/model/ar_model.hpp"
#include "noise/model/texture_model.hpp"

namespace tribo::noise {

// `pieces` of sound at the model's rate, made at this speed. Nothing where the sound is Gaussian.
std::optional<TextureModel> learn_texture(std::span<const std::span<const double>> pieces,
                                          const ArModel& model, double speed_mm_per_s);

// Grains of a residual (white, mean square 1): impulses that stand out of their surroundings by
// kGrainThreshold. In `residual` noise of their surroundings' level takes their place. `sample_rate_hz` over
// speed makes distances of times.
inline constexpr double kGrainThreshold = 5.5;
GrainModel take_grains(std::vector<double>& residual, double sample_rate_hz, double speed_mm_per_s);

}  // namespace tribo::noise
