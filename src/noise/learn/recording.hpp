// SPDX-License-Identifier: MIT
// Prepares a recording of friction for learning: removes baseline and silence, counts faults. Allocates; any
// thread.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace tribo::noise {

struct Recording {
    std::string name;  // used in messages
    double speed_mm_per_s = 0;
    double force_n = 1;
    double sample_rate_hz = 48000;
    std::vector<double> samples;  // mono, full scale 1
};

// Highest sample rate for learning. Faster recordings are resampled to it: higher frequencies are inaudible
// and would only cost poles.
inline constexpr double kFastestLearnedHz = 48000;
// Less sound than this gives no reliable spectrum.
inline constexpr double kShortestS = 0.2;

struct PreparedRecording {
    double sample_rate_hz = 48000;
    std::vector<double> sound;              // after the high-pass, without silent stretches
    std::vector<std::size_t> stretches{0};  // start indices of the stretches in `sound`
    double level_db = 0;                    // RMS of `sound`, dB of full scale
    double peak_db = 0;                     // of the original recording
    double silent_share = 0, clipped_share = 0;
    Warnings warnings;

    // Returns the stretches, one span each.
    std::vector<std::span<const double>> pieces() const;
};

// `highpass_hz`: corner of a second-order Butterworth high-pass; 0: only the mean is removed. Silence is
// sound 50 dB below the loudest tenth of the recording for a quarter of a second, or exactly constant samples
// for 20 ms. Clipping is a run of three or more samples at one extreme, within 1 % of full scale or of the
// peak. Refuses recordings with no samples, non-finite samples, silence only, or less than kShortestS of
// sound.
Result<PreparedRecording> prepare(const Recording& recording, double highpass_hz);

// Band-limited resampling to a lower rate: windowed sinc, flat up to 0.9 of the new half rate, -80 dB above
// it.
std::vector<double> brought_down(std::span<const double> samples, double from_hz, double to_hz);

}  // namespace tribo::noise
