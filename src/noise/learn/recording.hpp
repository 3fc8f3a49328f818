// SPDX-License-Identifier: MIT
// A recording of friction, made ready to learn from: baseline removed, silence cut out, faults counted.
// Allocates; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace tribo::noise {

struct Recording {
    std::string name;  // in messages
    double speed_mm_per_s = 0;
    double force_n = 1;
    double sample_rate_hz = 48000;
    std::vector<double> samples;  // mono, full scale 1
};

// Learned at this rate at most: faster recordings are brought down to it, for what lies above is not heard
// and would only cost poles.
inline constexpr double kFastestLearnedHz = 48000;
// Less sound than this tells no spectrum.
inline constexpr double kShortestS = 0.2;

struct PreparedRecording {
    double sample_rate_hz = 48000;
    std::vector<double> sound;              // high-passed; silent stretches left out
    std::vector<std::size_t> stretches{0};  // where stretches start in `sound`: joints between them
    double level_db = 0;                    // RMS of `sound`, dB of full scale
    double peak_db = 0;                     // of the recording as it came
    double silent_share = 0, clipped_share = 0;
    Warnings warnings;

    // The stretches one by one.
    std::vector<std::span<const double>> pieces() const;
};

// `highpass_hz`: corner of a second-order Butterworth high-pass; 0: only the mean is removed. Silent is what
// stays 50 dB under the louder tenth of the recording for a quarter of a second, or is exactly constant for
// 20 ms. Clipped are runs of three and more samples at one extreme within 1 % of full scale or of the peak.
// Refused: no samples, numbers that are none, silence, less than kShortestS of sound.
Result<PreparedRecording> prepare(const Recording& recording, double highpass_hz);

// Band-limited resampling to a lower rate: windowed sinc, flat to 0.9 of the new half rate, -80 dB above it.
std::vector<double> brought_down(std::span<const double> samples, double from_hz, double to_hz);

}  // namespace tribo::noise
