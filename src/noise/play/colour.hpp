// SPDX-License-Identifier: MIT
// A model of noise from a given spectrum, without a recording.
#pragma once

#include <span>

#include "noise/model/ar_model.hpp"

namespace tribo::noise {

// A point of a spectrum: the level of a third octave at `hz`, dB. Only differences between levels matter.
struct ColourPoint {
    double hz = 0, db = 0;
};

// Returns an all-pole model of the spectrum through the points. Between points it is linear in dB over
// octaves. Below the first and above the last point it continues the neighbouring line, down to -200 dB at
// most. At least two points, hz ascending. Order 1 ... kLargestOrder: few poles round the corners. Allocates;
// any thread. By the autocorrelation of the spectrum (Makhoul 1975, "Linear prediction: a tutorial review",
// section III).
ArModel model_of(std::span<const ColourPoint> colour, double sample_rate_hz, int order);

}  // namespace tribo::noise
