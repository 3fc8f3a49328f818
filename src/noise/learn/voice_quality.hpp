// SPDX-License-Identifier: MIT
// How near a learned voice comes to its recording: what `tribo learn --report` shows. Allocates; any thread.
#pragma once

#include <vector>

#include "noise/learn/learning.hpp"

namespace tribo::noise {

// The recording, the voice without its texture, the voice: in this order.
struct Trio {
    double original = 0, gaussian = 0, voice = 0;
};

// Levels of half bands of an octave of the envelope's fluctuation, dB relative to its mean square.
struct ModulationSpectrum {
    std::vector<double> hz, original_db, gaussian_db, voice_db;
};

struct VoiceQuality {
    double sample_rate_hz = 48000;
    // Fitted on one half of the recording's blocks, held against the spectrum of the other; shape alone, 200
    // Hz to 20 kHz. Beside it the same for a plain Yule-Walker fit of order 50, and what the two halves
    // differ by themselves.
    double held_out_db = 0, held_out_plain_db = 0, halves_db = 0;
    double level_error_db = 0;  // of a minute played, against the level that was learned
    // Of the recording as it is; the level deviation (10 ms) and the modulation without its slow level.
    Trio kurtosis, deviation_db;
    std::vector<double> hz, original_db, model_db;  // spectra
    ModulationSpectrum modulation;
    std::vector<float> original, gaussian, voice;  // sound, up to kHeardS of it
};
inline constexpr double kHeardS = 4;

VoiceQuality quality_of(const VoiceModel& model, const PreparedRecording& recording, double highpass_hz);

}  // namespace tribo::noise
