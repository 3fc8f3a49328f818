// SPDX-License-Identifier: MIT
// The slow level of a recording: a hand that rubs freehand moves faster and slower, presses harder and
// lighter, several times in a second. That is the stroke's, not the surface's; a voice gets it from the
// stroke that is played. Allocates; any thread.
#pragma once

#include <span>
#include <vector>

namespace tribo::noise {

// Modulation below this is slow.
inline constexpr double kSlowHz = 4;

// The pieces with their slow level divided out. The slow level is the level in dB of frames of 10 ms,
// low-passed at kSlowHz, and of it as much as it fluctuates more than the octave above kSlowHz would have it:
// clicks at random places fluctuate as much below kSlowHz as above, and lose nothing.
std::vector<std::vector<double>> without_slow_level(std::span<const std::span<const double>> pieces,
                                                    double sample_rate_hz);

}  // namespace tribo::noise
