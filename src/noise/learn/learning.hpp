// SPDX-License-Identifier: MIT
// From recordings of friction to the voices of a material.
//
// Each recording: high-pass, silence out, autocorrelation under Hann windows of 4096 samples, Yule-Walker
// equations by Levinson and Durbin (or Burg's method), RMS level. Recordings at one speed and force are
// learned from together. One order serves all models of a material: the smallest whose distance from the
// spectrum of held-out sound is within kOrderToleranceDb of the best. What a recording is beyond Gaussian
// noise becomes its texture (texture_learning.hpp); of several at one speed and force that of the longest.
// Paper: the touch paper, 3.1, with RMS in place of mean power. Allocates; any thread.
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
    std::optional<int> order{};  // 1 ... kLargestOrder; absent: by held-out sound
    double highpass_hz = 50;     // 0: only the mean is removed
    bool textures = true;        // false: Gaussian models alone
};

inline constexpr int kMostLearnedOrder = 100;
inline constexpr double kOrderToleranceDb = 0.05;
inline constexpr std::size_t kAutocorrelationFrame = 4096;

// What was learned from one recording.
struct LearnedRecording {
    std::string name;
    int model = 0;  // index into voices.models
    double seconds = 0;
    double level_db = 0, peak_db = 0, silent_share = 0, clipped_share = 0;
};

struct Learned {
    MaterialVoices voices;
    int order = 0;
    // Distance of the models of one half of the sound from the spectrum of the other (shape_distance_db), at
    // each order 1, 2, ..., mean over the recordings; empty where the order was given.
    std::vector<double> held_out_db;
    std::vector<LearnedRecording> recordings;  // as they came
    Warnings warnings;
};

// Any number of recordings in any order. Refused: none, speeds or forces that are not above 0, what
// prepare() refuses.
Result<Learned> learn(std::span<const Recording> recordings, const LearningOptions& options = {});

// Autocorrelation r_0 ... r_lags of sound that went through prepare()'s high-pass, as if nothing had been
// removed: above the corner the filter's loss is made good, below it the spectrum goes on as it is just
// above. So the fit does not bend to a hole that the recording never had. r_0 is the mean square.
std::vector<double> windowed_autocorrelation(std::span<const std::span<const double>> pieces,
                                             double sample_rate_hz, double highpass_hz, int lags);

// The bass of pieces that went through prepare()'s high-pass; none where `whole` tells of it within 1 dB (RMS
// over third octaves), where there is none, or where no piece is long enough for 3 Hz (0.4 s at 44.1 kHz).
std::optional<BassModel> learn_bass(std::span<const std::span<const double>> pieces, const ArModel& whole,
                                    double highpass_hz);

}  // namespace tribo::noise
