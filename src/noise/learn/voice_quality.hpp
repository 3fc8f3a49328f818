// SPDX-License-Identifier: MIT
// Distance between a learned voice and its recording, for `tribo learn --report`. Allocates; any thread.
#pragma once

#include <vector>

#include "noise/learn/learning.hpp"

namespace tribo::noise {

// Values of the recording, the voice without its texture, and the voice.
struct Trio {
    double original = 0, gaussian = 0, voice = 0;
};

// Levels of the fluctuation of the envelope in half octaves, dB relative to its mean square.
struct ModulationSpectrum {
    std::vector<double> hz, original_db, gaussian_db, voice_db;
};

struct VoiceQuality {
    double sample_rate_hz = 48000;
    // Fit on one half of the blocks of the recording, compared with the spectrum of the other half; shape
    // only, 200 Hz to 20 kHz. Then the same for a plain Yule-Walker fit of order 50, and the difference
    // between the two halves.
    double held_out_db = 0, held_out_plain_db = 0, halves_db = 0;
    double level_error_db = 0;  // level of a minute of playback, relative to the learned level
    // Kurtosis of the unchanged recording. Level deviation (10 ms) and modulation without its slow level.
    Trio kurtosis, deviation_db;
    std::vector<double> hz, original_db, model_db;  // spectra
    ModulationSpectrum modulation;
    std::vector<float> original, gaussian, voice;  // sound, up to kHeardS of it
};
inline constexpr double kHeardS = 4;

VoiceQuality quality_of(const VoiceModel& model, const PreparedRecording& recording, double highpass_hz);

}  // namespace tribo::noise
