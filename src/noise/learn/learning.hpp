// SPDX-License-Identifier: MIT
// Learns the voices of a material from recordings of friction.
//
// Steps for each recording: high-pass, removal of silence, autocorrelation under Hann windows of 4096
// samples, Yule-Walker equations by Levinson and Durbin (or Burg's method), RMS level. Recordings at one
// speed and force give one model. All models of a material have the same order: the smallest one whose
// distance from the spectrum of held-out sound is within kOrderToleranceDb of the best. The part of a
// recording beyond Gaussian noise becomes its texture (texture_learning.hpp); with several recordings at one
// speed and force, the longest one gives the texture. Paper: the touch paper, 3.1, with RMS in place of mean
// power. Allocates; any thread.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "noise/learn/recording.hpp"
#include "noise/model/material_voices.hpp"

namespace tribo::noise {

enum class Method { yule_walker, burg };

struct LearningOptions {
    Method method = Method::yule_walker;
    std::optional<int> order{};  // 1 ... kLargestOrder; absent: chosen by held-out sound
    double highpass_hz = 50;     // 0: only the mean is removed
    bool textures = true;        // false: Gaussian models only
};

inline constexpr int kMostLearnedOrder = 100;
inline constexpr double kOrderToleranceDb = 0.05;
inline constexpr std::size_t kAutocorrelationFrame = 4096;

// The result for one recording.
struct LearnedRecording {
    std::string name;
    int model = 0;  // index into voices.models
    double seconds = 0;
    double level_db = 0, peak_db = 0, silent_share = 0, clipped_share = 0;
};

struct Learned {
    MaterialVoices voices;
    int order = 0;
    // Distance between the models of one half of the sound and the spectrum of the other half
    // (shape_distance_db), at each order 1, 2, ..., mean over the recordings. Empty if the order was given.
    std::vector<double> held_out_db;
    std::vector<LearnedRecording> recordings;  // in the order of the input
    Warnings warnings;
};

// Takes any number of recordings in any order. Refuses none at all, speeds or forces that are not > 0, and
// recordings that prepare() refuses.
Result<Learned> learn(std::span<const Recording> recordings, const LearningOptions& options = {});

// Returns the autocorrelation r_0 ... r_lags of sound after the high-pass of prepare(), with the effect of
// the high-pass removed: above the corner its loss is compensated, below the corner the spectrum is continued
// flat. Otherwise the model would follow a gap that the recording never had. r_0 is the mean square.
std::vector<double> windowed_autocorrelation(std::span<const std::span<const double>> pieces,
                                             double sample_rate_hz, double highpass_hz, int lags);

// Returns the bass model of pieces after the high-pass of prepare(). Returns none if `whole` is within 1 dB
// of the bass (RMS over third octaves), if there is no bass, or if no piece is long enough for 3 Hz (0.4 s at
// 44.1 kHz).
std::optional<BassModel> learn_bass(std::span<const std::span<const double>> pieces, const ArModel& whole,
                                    double highpass_hz);

}  // namespace tribo::noise
