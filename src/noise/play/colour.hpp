// SPDX-License-Identifier: MIT
// A model of noise from a drawn spectrum, where there is no recording to learn from.
#pragma once

#include <span>

#include "noise/model/ar_model.hpp"

namespace tribo::noise {

// A point of a spectrum: the level of a third octave at `hz`, dB. Only differences of levels count.
struct ColourPoint {
    double hz = 0, db = 0;
};

// An all-pole model of the spectrum that goes through the points, in straight lines of dB over octaves; below
// the first and above the last it goes on as in the line next to them, 200 dB down at most. At least two
// points, hz ascending; order 1 ... kLargestOrder: few poles round the corners. Allocates; any thread. By the
// spectrum's autocorrelation (Makhoul 1975, "Linear prediction: a tutorial review", section III).
ArModel model_of(std::span<const ColourPoint> colour, double sample_rate_hz, int order);

}  // namespace tribo::noise
