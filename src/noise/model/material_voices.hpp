// SPDX-License-Identifier: MIT
// The friction sound of a material: one model for each recorded speed (and force), and the law of its level.
// `tribo learn` computes it, a material file stores it, FrictionVoice plays it. Plain data.
#pragma once

#include <optional>
#include <vector>

#include "noise/model/ar_model.hpp"
#include "noise/model/texture_model.hpp"
#include "noise/play/bass_noise.hpp"

namespace tribo::noise {

// The sound at one speed and force.
struct VoiceModel {
    double speed_mm_per_s = 0;  // > 0
    double force_n = 1;         // > 0
    double level_db = 0;        // RMS, dB of full scale
    ArModel spectrum;
    std::optional<TextureModel> texture{};  // absent: Gaussian noise of that spectrum
    std::optional<BassModel> bass{};        // absent: `spectrum` is accurate enough in the bass

    friend bool operator==(const VoiceModel&, const VoiceModel&) = default;
};

// Level in dB, linear in the logarithms of speed and force: the best fit to the recordings. Between
// recordings the level is interpolated; the law holds beyond them.
struct LevelLaw {
    double level_db = 0;  // at 100 mm/s and 1 N
    // Friction noise grows about with the square root of friction power, force * speed (van den Doel, Kry,
    // Pai 2001): 10 dB per decade. This default is kept if recordings at one speed or one force give no
    // slope.
    double db_per_decade_speed = 10;
    double db_per_decade_force = 10;

    friend bool operator==(const LevelLaw&, const LevelLaw&) = default;
};
inline constexpr double kLawSpeedMmPerS = 100;
inline constexpr double kLawForceN = 1;

struct MaterialVoices {
    std::vector<VoiceModel> models;  // ascending by force, then speed; no two with equal speed and force
    LevelLaw law;

    friend bool operator==(const MaterialVoices&, const MaterialVoices&) = default;
};

// Limits of the slopes of a law and of its level.
inline constexpr double kSteepestLawDb = 200, kLeastLawDb = -200, kMostLawDb = 60;

// Fits the law to the levels of the models by least squares, within these limits.
LevelLaw fit_level_law(const std::vector<VoiceModel>& models);

}  // namespace tribo::noise
