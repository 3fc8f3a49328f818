// SPDX-License-Identifier: MIT
// The slow level of a recording. A hand that rubs freely changes its speed and force several times a second.
// This is a property of the stroke, not of the surface: in playback it comes from the played stroke.
// Allocates; any thread.
#pragma once

#include <span>
#include <vector>

namespace tribo::noise {

// Slower modulation than this is slow level.
inline constexpr double kSlowHz = 4;

// Returns the pieces divided by their slow level. The slow level is the level in dB of frames of 10 ms,
// low-passed at kSlowHz. Only the part by which it fluctuates more than the octave above kSlowHz is removed:
// clicks at random places fluctuate equally below and above kSlowHz and are not changed.
std::vector<std::vector<double>> without_slow_level(std::span<const std::span<const double>> pieces,
                                                    double sample_rate_hz);

}  // namespace tribo::noise
